// A recording: a scene, the method with every setting, the events in order, and the result.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "algo/result.h"
#include "algo/solve.h"
#include "recordings/scene_file.h"

namespace gjkdbg {

/// Events as a recording keeps them: world frame, owned.
namespace recorded {
using Face = FaceEvent<AnyVector, Owned>;
using GjkBegan = gjkdbg::GjkBegan<AnyVector, Owned>;
using SupportQueried = gjkdbg::SupportQueried<AnyVector, Owned>;
using SimplexReduced = gjkdbg::SimplexReduced<AnyVector, Owned>;
using GjkEnded = gjkdbg::GjkEnded<AnyVector, Owned>;
using PolytopeSeeded = gjkdbg::PolytopeSeeded<AnyVector, Owned>;
using FaceChosen = gjkdbg::FaceChosen<AnyVector, Owned>;
using PolytopeGrown = gjkdbg::PolytopeGrown<AnyVector, Owned>;
using EpaEnded = gjkdbg::EpaEnded<AnyVector, Owned>;
using Warning = gjkdbg::Warning<AnyVector, Owned>;
}  // namespace recorded

using Event = std::variant<recorded::GjkBegan, recorded::SupportQueried, recorded::SimplexReduced, recorded::GjkEnded,
                           recorded::PolytopeSeeded, recorded::FaceChosen, recorded::PolytopeGrown,
                           recorded::EpaEnded, recorded::Warning>;

/// "gjk_began", …
std::string_view kind_name(const Event& event);

struct Recording {
  std::string generator;
  SceneFile scene;
  Settings settings;
  std::vector<Event> events;
  Result result;
};

/// Keeps every event of a run.
class Recorder final : public TraceSink {
 public:
  void operator()(const world::GjkBegan&) override;
  void operator()(const world::SupportQueried&) override;
  void operator()(const world::SimplexReduced&) override;
  void operator()(const world::GjkEnded&) override;
  void operator()(const world::PolytopeSeeded&) override;
  void operator()(const world::FaceChosen&) override;
  void operator()(const world::PolytopeGrown&) override;
  void operator()(const world::EpaEnded&) override;
  void operator()(const world::Warning&) override;

  std::vector<Event> take() { return std::move(events_); }

 private:
  std::vector<Event> events_;
};

/// Solves the scene and keeps everything. Throws Error when the method cannot be resolved (place "/method/…").
Recording record(const SceneFile& scene);
Recording record(const SceneFile& scene, const Settings& settings);

/// Who writes our recordings: "gjkdbg VERSION".
std::string generator_name();

/// JSON text, one event a line, every double so that it reads back bit for bit, unset and non-finite values as null.
std::string recording_to_text(const Recording& recording);

/// Throws Error (place: JSON pointer or line) for anything that is not a whole recording: event fields missing, unknown or
/// mistyped, vectors of the wrong dimension, … Never crashes. What the events *say* is not judged: a recording of a wrong
/// solver, with vertices that nobody asked for, is still a recording. A direction may hold nulls, read as NaN.
Recording parse_recording(std::string_view text, const std::filesystem::path& directory);
Recording read_recording(const std::filesystem::path& file);

}  // namespace gjkdbg
