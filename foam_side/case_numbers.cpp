// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/case_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "IOdictionary.H"
#include "coupler/base/errors.hpp"
#include "foam_side/viscous_rate.hpp"

namespace demvof {
namespace {

using Foam::dictionary;
using Foam::word;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// What a number may be.
struct Range {
  double lowest, highest;
  bool open = false;  // the lowest is not allowed
  const char* unit = "";

  bool has(double value) const {
    return std::isfinite(value) && value <= highest && (open ? value > lowest : value >= lowest);
  }
  std::string text() const {
    const std::string above =
        open ? fmt::format("above {:g}", lowest) : fmt::format("of {:g} or more", lowest);
    const std::string below = highest < unbounded ? fmt::format(" and at most {:g}", highest) : "";
    return fmt::format("give a number {}{}{}", above, below, unit);
  }
};

[[noreturn]] void refuse(const std::string& file, const dictionary& in, const Foam::entry& entry,
                         const std::string& where, const std::string& allowed) {
  const label line = entry.isStream() ? entry.startLineNumber() : in.startLineNumber();
  throw InputError(fmt::format("{}:{}: {}{}: {} is not allowed; {}", file, line, where,
                               static_cast<const std::string&>(entry.keyword()),
                               entry.stream().toString().c_str(), allowed));
}

/// The number behind a key, when there is one; what is no plain number is OpenFOAM's to judge.
std::optional<double> number(const Foam::entry& entry) {
  if (!entry.isStream() || entry.stream().size() != 1) return std::nullopt;
  const Foam::token& token = entry.stream()[0];
  if (!token.isNumber()) return std::nullopt;
  return token.number();
}

/// One of the case's dictionaries, by the name that its user knows.
class Entries {
 public:
  Entries(std::string file, const dictionary& in, std::string where = "")
      : file_(std::move(file)), in_(in), where_(std::move(where)) {}

  std::optional<double> operator[](const char* key) const {
    const Foam::entry* const entry = in_.findEntry(key, Foam::keyType::REGEX);
    return entry ? number(*entry) : std::nullopt;
  }
  void require(const char* key, const Range& range) const {
    const Foam::entry* const entry = in_.findEntry(key, Foam::keyType::REGEX);
    const std::optional<double> value = entry ? number(*entry) : std::nullopt;
    if (value && !range.has(*value)) refuse(file_, in_, *entry, where_, range.text());
  }
  /// All numbers below.
  void require_all(const Range& range) const { require_all(in_, where_, range); }

 private:
  void require_all(const dictionary& in, const std::string& where, const Range& range) const {
    for (const Foam::entry& entry : in) {
      if (entry.isDict())
        require_all(entry.dict(), where + static_cast<const std::string&>(entry.keyword()) + ": ", range);
      else if (const std::optional<double> value = number(entry); value && !range.has(*value))
        refuse(file_, in, entry, where, range.text());
    }
  }

  std::string file_;
  const dictionary& in_;
  std::string where_;
};

void require_times(const Foam::Time& time) {
  const dictionary& control = time.controlDict();
  const Entries entries("system/controlDict", control);
  const Range positive{0, unbounded, true}, seconds{0, unbounded, true, " (s)"};
  entries.require("deltaT", seconds);
  if (!control.lookupOrDefault("adjustTimeStep", false)) return;
  entries.require("maxCo", positive);
  entries.require("maxAlphaCo", positive);
  entries.require("maxDeltaT", seconds);
}

void require_loops(const dictionary& solution, bool particles) {
  const dictionary& pimple = solution.subOrEmptyDict("PIMPLE");
  const Entries entries("system/fvSolution", pimple, "PIMPLE: ");
  entries.require("nOuterCorrectors", {1, unbounded});
  // A flow that is given has -1 of both.
  const bool given = entries["nNonOrthogonalCorrectors"].value_or(0) == -1;
  if (given && entries["nCorrectors"].value_or(1) == -1) {
    if (!particles) return;
    throw InputError(
        "system/fvSolution: PIMPLE: nCorrectors: -1: a flow that is given takes no momentum from particles: "
        "have it solved (1 or more, frozenFlow no), or run without particles");
  }
  entries.require("nCorrectors", {1, unbounded});
  entries.require("nNonOrthogonalCorrectors", {0, unbounded});
}

void require_surface(const dictionary& solution, const word& alpha) {
  const dictionary& solvers = solution.subOrEmptyDict("solvers");
  const dictionary* const controls = solvers.findDict(alpha, Foam::keyType::REGEX);
  if (!controls) return;
  const Entries entries("system/fvSolution", *controls,
                        fmt::format("{}: ", static_cast<const std::string&>(alpha)));
  entries.require("nAlphaCorr", {1, unbounded});
  entries.require("nAlphaSubCycles", {1, unbounded});
  entries.require("cAlpha", {0, unbounded});
  entries.require("icAlpha", {0, unbounded});
  entries.require("scAlpha", {0, unbounded});
  entries.require("nLimiterIter", {1, unbounded});
}

void require_solver(const Flow& flow, const char* name, const char* like, const char* why) {
  const dictionary& solvers = flow.mesh.solutionDict().subOrEmptyDict("solvers");
  if (solvers.findDict(name, Foam::keyType::REGEX)) return;
  throw InputError(
      fmt::format("system/fvSolution: solvers: {} is missing{}; add {}{}", name, why, name, like));
}

/// What OpenFOAM has under a name, for matrices of one kind.
template <class Table>
void require_known(const Table* table, const dictionary& in, const char* key, const std::string& where,
                   const char* kind) {
  const Foam::entry* const entry = in.findEntry(key, Foam::keyType::LITERAL);
  if (!entry || !table) return;
  const dictionary& part = entry->isDict() ? entry->dict() : in;
  const word name(part.lookup(key));
  if (table->found(name)) return;
  std::string all;
  for (const word& known : table->sortedToc()) all += fmt::format(" {}", known.c_str());
  throw InputError(fmt::format("system/fvSolution:{}: {}: {}: {} is not known for {} matrices; give one of{}",
                               part.lookupEntry(key, Foam::keyType::LITERAL).startLineNumber(), where, key,
                               name.c_str(), kind, all));
}

/// A fluid at rest asks for none of it in its first step.
template <class Parts>
void require_parts(const Parts& parts, const dictionary& solvers, const char* name, const char* kind) {
  const dictionary* const solver = solvers.findDict(name, Foam::keyType::REGEX);
  if (!solver) return;
  const std::string where = std::string("solvers: ") + name;
  require_known(parts.solvers, *solver, "solver", where, kind);
  const word type = solver->lookupOrDefault<word>("solver", "");
  const bool smooths = type == "GAMG" || type == "smoothSolver";
  if (smooths)
    require_known(parts.smoothers, *solver, "smoother", where, kind);
  else
    require_known(parts.preconditioners, *solver, "preconditioner", where, kind);
}

template <class Solvers, class Smoothers, class Preconditioners>
struct Parts {
  const Solvers* solvers;
  const Smoothers* smoothers;
  const Preconditioners* preconditioners;
};
template <class... Tables>
Parts(const Tables*...) -> Parts<Tables...>;

void require_known_parts(const Flow& flow, bool momentum) {
  using Matrix = Foam::lduMatrix;
  const dictionary& solvers = flow.mesh.solutionDict().subOrEmptyDict("solvers");
  const Parts symmetric{Matrix::solver::symMatrixConstructorTablePtr_,
                        Matrix::smoother::symMatrixConstructorTablePtr_,
                        Matrix::preconditioner::symMatrixConstructorTablePtr_};
  const Parts asymmetric{Matrix::solver::asymMatrixConstructorTablePtr_,
                         Matrix::smoother::asymMatrixConstructorTablePtr_,
                         Matrix::preconditioner::asymMatrixConstructorTablePtr_};
  for (const char* name : {"p_rgh", "p_rghFinal", "pcorr", "pcorrFinal"})
    require_parts(symmetric, solvers, name, "symmetric");
  for (const char* name : {"U", "UFinal"})
    if (momentum) require_parts(asymmetric, solvers, name, "asymmetric");
}

}  // namespace

void require_numbers_that_can_be(const Foam::Time& time, bool particles) {
  require_times(time);
  const Foam::IOdictionary solution(Foam::IOobject(
      "fvSolution", time.system(), time, Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE, false));
  const Foam::IOdictionary transport(Foam::IOobject("transportProperties", time.constant(), time,
                                                    Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE,
                                                    false));
  const Foam::wordList phases(transport.lookup("phases"));
  if (phases.size() != 2)
    throw InputError(fmt::format(
        "constant/transportProperties:{}: phases: {} of them; give two, the liquid first",
        transport.lookupEntry("phases", Foam::keyType::LITERAL).startLineNumber(), phases.size()));
  require_loops(solution, particles);
  require_surface(solution, "alpha." + phases[0]);
  Entries("system/fvSolution", solution.subOrEmptyDict("relaxationFactors"), "relaxationFactors: ")
      .require_all({0, 1, true});
}

void require_solvers(const Flow& flow, double longest_step) {
  // A flow that is given has none.
  if (flow.pimple.nNonOrthCorr() < 0 || flow.pimple.frozenFlow()) return;
  require_solver(flow, "p_rghFinal", " { $p_rgh; relTol 0; }", "");
  if (flow.pimple.nCorrPISO() > 1 || flow.pimple.nCorrPIMPLE() > 1 || flow.pimple.nNonOrthCorr() > 0)
    require_solver(flow, "p_rgh", " { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0.05; }", "");
  require_solver(flow, "pcorrFinal", " or \"pcorr.*\" { $p_rgh; relTol 0; }", ", for the flux at the start");
  if (flow.source)
    require_solver(flow, "pcorr", " or \"pcorr.*\" { $p_rgh; relTol 0; }", ", for the particles' flux");
  const double number = viscous_rate(flow) * longest_step, most = flow.source ? most_of_corrections : 1;
  const bool asked = flow.pimple.momentumPredictor();
  require_known_parts(flow, asked || number > most);
  if (!asked && number <= most) return;
  const std::string why =
      asked
          ? ", and momentumPredictor is on"
          : fmt::format(", and nu dt/dx2 may be {:.2g}, above {:g} of which the momentum equation is solved",
                        number, most);
  const char* like = " { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }";
  require_solver(flow, "UFinal", like, why.c_str());
  if (flow.pimple.nCorrPIMPLE() > 1) require_solver(flow, "U", like, why.c_str());
}

std::string pimple_by_default(const Foam::fvMesh& mesh) {
  if (mesh.solutionDict().found("PIMPLE")) return {};
  return "system/fvSolution has no PIMPLE: OpenFOAM's defaults hold, one pressure correction a step "
         "(nCorrectors 1) among them; three are usual with particles";
}

}  // namespace demvof
