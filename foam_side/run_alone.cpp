// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run_alone.hpp"

#include "coupler/base/stopwatch.hpp"
#include "coupler/link/signals.hpp"
#include "foam_side/fluid_case.hpp"
#include "foam_side/step_fluid.hpp"
#include "foam_side/write_fields.hpp"

namespace demvof {

RunStatus run_alone(Flow& flow, const CaseParameters& parameters, RunRecord& record) {
  if (parameters.coupling.end_time > 0) flow.time.setEndTime(parameters.coupling.end_time);
  set_gravity(flow, flow.gravity.at(flow.time.value()));
  FluidSeconds seconds;
  record.start(flow, nullptr);
  bool go_on = true;
  for (long n = 1; go_on; ++n) {
    {
      const Stopwatch watch(seconds.fluid);
      if (!step_fluid(flow, nullptr)) return RunStatus::completed;
    }
    RunRecord::Window done;
    done.number = n;
    done.fluid = take_report(flow);
    done.seconds = seconds;
    require_whole_log();
    record.window(flow, done, flow.time.endTime().value());
    go_on = !Foam::returnReduce(stop_requested(), Foam::orOp<bool>());
  }
  write_fields(flow);
  return RunStatus::interrupted;
}

}  // namespace demvof
