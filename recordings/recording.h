// A recording: a scene, the method with every setting, the events in order, and the result.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
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
using VertexKept = gjkdbg::VertexKept<AnyVector, Owned>;
using SupportQueried = gjkdbg::SupportQueried<AnyVector, Owned>;
using SimplexReduced = gjkdbg::SimplexReduced<AnyVector, Owned>;
using GjkEnded = gjkdbg::GjkEnded<AnyVector, Owned>;
using PolytopeSeeded = gjkdbg::PolytopeSeeded<AnyVector, Owned>;
using FaceChosen = gjkdbg::FaceChosen<AnyVector, Owned>;
using PolytopeGrown = gjkdbg::PolytopeGrown<AnyVector, Owned>;
using EpaEnded = gjkdbg::EpaEnded<AnyVector, Owned>;
using MprBegan = gjkdbg::MprBegan<AnyVector, Owned>;
using PortalFound = gjkdbg::PortalFound<AnyVector, Owned>;
using MprEnded = gjkdbg::MprEnded<AnyVector, Owned>;
using SatBegan = gjkdbg::SatBegan<AnyVector, Owned>;
using AxisTested = gjkdbg::AxisTested<AnyVector, Owned>;
using PointsProjected = gjkdbg::PointsProjected<AnyVector, Owned>;
using SatEnded = gjkdbg::SatEnded<AnyVector, Owned>;
using ClosedFormBegan = gjkdbg::ClosedFormBegan<AnyVector, Owned>;
using LinesSolved = gjkdbg::LinesSolved<AnyVector, Owned>;
using ClosedFormEnded = gjkdbg::ClosedFormEnded<AnyVector, Owned>;
using ProjectionsBegan = gjkdbg::ProjectionsBegan<AnyVector, Owned>;
using PointPredicted = gjkdbg::PointPredicted<AnyVector, Owned>;
using ProjectionsEnded = gjkdbg::ProjectionsEnded<AnyVector, Owned>;
using CastBegan = gjkdbg::CastBegan<AnyVector, Owned>;
using CastAdvanced = gjkdbg::CastAdvanced<AnyVector, Owned>;
using CastEnded = gjkdbg::CastEnded<AnyVector, Owned>;
using BodyState = gjkdbg::BodyState<AnyVector, Owned>;
using State = gjkdbg::State<AnyVector, Owned>;
using ContactFound = gjkdbg::ContactFound<AnyVector, Owned>;
using ImpulseApplied = gjkdbg::ImpulseApplied<AnyVector, Owned>;
using Warning = gjkdbg::Warning<AnyVector, Owned>;
}  // namespace recorded

template <class List>
struct VariantOf;
template <class... Events>
struct VariantOf<EventList<Events...>> {
  using type = std::variant<Events...>;
};
using Event = VariantOf<AllEvents<AnyVector, Owned>>::type;

/// The vertex of the difference that an event gives out a number for, if it does.
struct GivenVertex {
  int vertex;
  const AnyVector &a, &b, &w;
};
std::optional<GivenVertex> given_vertex(const Event& event);

/// "gjk_began", …
std::string_view kind_name(const Event& event);

struct Recording {
  std::string generator;
  SceneFile scene;
  Settings settings;
  std::vector<Event> events;
  Result result;
};

/// Whether GJK begins once more here, on the same bodies, where its first run has stalled (algo/run_gjk.h): along -v, which no other run begins with.
bool begins_again(const Recording& recording, std::size_t step);

/// Keeps every event of a run.
class Recorder final : public SinkTaking<Recorder> {
 public:
  template <template <class, class> class E>
  void take(const E<AnyVector, Viewed>& event) {
    E<AnyVector, Owned> kept;
    keep_fields(event, kept);
    events_.push_back(std::move(kept));
  }

  std::vector<Event> take_all() { return std::move(events_); }

 private:
  template <class T>
  static void keep(const T& from, T& to) {
    to = from;
  }
  static void keep(std::string_view from, std::string& to) { to = from; }
  template <class From, class To>
  static void keep(std::span<const From> from, std::vector<To>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) keep(from[i], to[i]);
  }
  static void keep(const FaceEvent<AnyVector, Viewed>& from, recorded::Face& to) { keep_fields(from, to); }
  static void keep(const world::BodyState& from, recorded::BodyState& to) { keep_fields(from, to); }

  /// Both declare the same fields in the same order.
  template <class From, class To>
  static void keep_fields(const From& from, To& to) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (keep(from.*std::get<I>(From::fields()).member, to.*std::get<I>(To::fields()).member), ...);
    }(std::make_index_sequence<std::tuple_size_v<decltype(From::fields())>>());
  }

  std::vector<Event> events_;
};

/// Solves the scene and keeps everything. Throws Error when the method cannot be resolved (place "/method/…").
Recording record(const SceneFile& scene);
Recording record(const SceneFile& scene, const Settings& settings);

/// Who writes our recordings: "gjkdbg VERSION".
std::string generator_name();
/// Whether another implementation's run was recorded: its generator is no version of ours.
bool foreign(const Recording& recording);

/// JSON text, one event a line, every double so that it reads back bit for bit, unset and non-finite values as null.
std::string recording_to_text(const Recording& recording);

/// Throws Error (place: JSON pointer or line) for anything that is not a whole recording: event fields missing, unknown or
/// mistyped, vectors of the wrong dimension, … Never crashes. What the events *say* is not judged: a recording of a wrong
/// solver, with vertices that nobody asked for, is still a recording. A direction and a closest point may hold nulls, bounds may be null: read as NaN.
Recording parse_recording(std::string_view text, const std::filesystem::path& directory);
Recording read_recording(const std::filesystem::path& file);

}  // namespace gjkdbg
