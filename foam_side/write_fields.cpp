// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/write_fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "IFstream.H"
#include "coupler/base/errors.hpp"
#include "foam_side/case_sources.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

/// The last bytes of a file of OpenFOAM, compressed or not.
std::string end_of_file(const fs::path& file) {
  constexpr std::streamoff wanted = 100;
  std::string end;
  if (fs::exists(file)) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    const std::streamoff size = stream.tellg();
    stream.seekg(std::max<std::streamoff>(0, size - wanted));
    end.assign(std::istreambuf_iterator<char>(stream), {});
  } else if (fs::exists(file.string() + ".gz")) {
    Foam::IFstream stream(file.string());
    std::vector<char> block(65536);
    while (stream.stdStream().read(block.data(), 65536), stream.stdStream().gcount() > 0)
      end = (end + std::string(block.data(), stream.stdStream().gcount()));
    end.erase(0, end.size() > wanted ? end.size() - wanted : 0);
  }
  return end;
}

/// OpenFOAM ends each file with a row of stars.
void require_file(const fs::path& file) {
  const std::string end = end_of_file(file);
  const std::string stars = "* //\n";
  if (end.size() < stars.size() || end.compare(end.size() - stars.size(), stars.size(), stars) != 0)
    throw RunError(fmt::format("{} was not written to its end: is the disk full?", file.string()));
}

/// Everything that belongs into the present time folder.
void require_files(const Foam::objectRegistry& objects, const std::string& time_name) {
  forAllConstIters(objects, entry) {
    const Foam::regIOobject& object = **entry;
    if (const auto* inner = dynamic_cast<const Foam::objectRegistry*>(&object)) {
      if (inner != &objects) require_files(*inner, time_name);
    } else if (object.writeOpt() == Foam::IOobject::AUTO_WRITE && object.instance() == time_name) {
      require_file(static_cast<const std::string&>(object.objectPath()));
    }
  }
}

/// Digits of the names of time folders.
struct TimeName : Foam::Time {
  static int& digits() { return precision_; }
  static int most_digits() { return maxPrecision_; }
};

/// OpenFOAM gives a time's name more digits than timePrecision says, when it takes them to tell it from the
/// time of the step before; but only where controlDict's writeControl writes.
void name_the_time(Foam::Time& time) {
  while (TimeName::digits() < TimeName::most_digits() &&
         std::abs(std::stod(time.timeName()) - time.value()) > 0.1 * time.deltaTValue()) {
    ++TimeName::digits();
    static_cast<Foam::dimensionedScalar&>(time).name() = time.timeName(time.value());
  }
}

}  // namespace

fs::path time_folder(const Flow& flow) {
  return static_cast<const std::string&>(flow.time.timePath());
}

void write_fields(Flow& flow) {
  name_the_time(flow.time);
  const bool opened = flow.time.writeNow();
  write_source_states(flow);
  require_file(time_folder(flow) / "uniform" / "time");
  require_files(flow.time, flow.time.timeName());  // names the file
  if (!opened)
    throw RunError(
        fmt::format("OpenFOAM could not write all of {}: is the disk full?", time_folder(flow).string()));
}

}  // namespace demvof
