// solve: a scene and a method in, a result out, and every step to a sink.
#pragma once

#include "algo/result.h"
#include "algo/settings.h"
#include "algo/trace.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// What a sink of solve() is handed: world frame, views valid during the call only.
namespace world {
using GjkBegan = gjkdbg::GjkBegan<AnyVector, Viewed>;
using VertexKept = gjkdbg::VertexKept<AnyVector, Viewed>;
using SupportQueried = gjkdbg::SupportQueried<AnyVector, Viewed>;
using SimplexReduced = gjkdbg::SimplexReduced<AnyVector, Viewed>;
using GjkEnded = gjkdbg::GjkEnded<AnyVector, Viewed>;
using PolytopeSeeded = gjkdbg::PolytopeSeeded<AnyVector, Viewed>;
using FaceChosen = gjkdbg::FaceChosen<AnyVector, Viewed>;
using PolytopeGrown = gjkdbg::PolytopeGrown<AnyVector, Viewed>;
using EpaEnded = gjkdbg::EpaEnded<AnyVector, Viewed>;
using MprBegan = gjkdbg::MprBegan<AnyVector, Viewed>;
using PortalFound = gjkdbg::PortalFound<AnyVector, Viewed>;
using MprEnded = gjkdbg::MprEnded<AnyVector, Viewed>;
using SatBegan = gjkdbg::SatBegan<AnyVector, Viewed>;
using AxisTested = gjkdbg::AxisTested<AnyVector, Viewed>;
using PointsProjected = gjkdbg::PointsProjected<AnyVector, Viewed>;
using SatEnded = gjkdbg::SatEnded<AnyVector, Viewed>;
using ClosedFormBegan = gjkdbg::ClosedFormBegan<AnyVector, Viewed>;
using LinesSolved = gjkdbg::LinesSolved<AnyVector, Viewed>;
using ClosedFormEnded = gjkdbg::ClosedFormEnded<AnyVector, Viewed>;
using ProjectionsBegan = gjkdbg::ProjectionsBegan<AnyVector, Viewed>;
using PointPredicted = gjkdbg::PointPredicted<AnyVector, Viewed>;
using ProjectionsEnded = gjkdbg::ProjectionsEnded<AnyVector, Viewed>;
using CastBegan = gjkdbg::CastBegan<AnyVector, Viewed>;
using CastAdvanced = gjkdbg::CastAdvanced<AnyVector, Viewed>;
using CastEnded = gjkdbg::CastEnded<AnyVector, Viewed>;
using BodyState = gjkdbg::BodyState<AnyVector, Viewed>;
using State = gjkdbg::State<AnyVector, Viewed>;
using ContactFound = gjkdbg::ContactFound<AnyVector, Viewed>;
using ImpulseApplied = gjkdbg::ImpulseApplied<AnyVector, Viewed>;
using Warning = gjkdbg::Warning<AnyVector, Viewed>;
}  // namespace world

template <class Event>
class SinkFor {
 public:
  virtual ~SinkFor() = default;
  virtual void operator()(const Event&) = 0;
};
template <class List>
class SinkForAll;
template <class... Events>
class SinkForAll<EventList<Events...>> : public SinkFor<Events>... {
 public:
  using SinkFor<Events>::operator()...;
};

/// A sink whose type is not known to the algorithms: one virtual call an event, an operator() for each kind.
using TraceSink = SinkForAll<AllEvents<AnyVector, Viewed>>;

/// A TraceSink that hands every event to one function template, `Self::take`.
template <class Self, class Base = TraceSink, class List = AllEvents<AnyVector, Viewed>>
class SinkTaking;
template <class Self, class Base>
class SinkTaking<Self, Base, EventList<>> : public Base {};
template <class Self, class Base, class Event, class... Rest>
class SinkTaking<Self, Base, EventList<Event, Rest...>> : public SinkTaking<Self, Base, EventList<Rest...>> {
 public:
  using SinkTaking<Self, Base, EventList<Rest...>>::operator();
  void operator()(const Event& event) override { static_cast<Self*>(this)->take(event); }
};

/// Fills in the defaults for a scene. Throws Error (place: a JSON pointer into the scene, "/method/name", "/bodies", "/query", …) for values out of range, for
/// combinations that do not exist and for scenes that the method does not take.
Settings resolve_settings(const Method& method, const Scene& scene);

/// In scene lengths: how far a computed support plane of the scene's first two bodies may be off, in the settings' precision (algo/minkowski_difference.h). Of a mesh: its first triangle's.
double rounding_floor(const Scene& scene, const Settings& settings);

/// Solves the scene's query: of two bodies, of two or more for a cast, of one or more for a simulation. Their shapes must pass `validate` (shapes/shape.h), or come
/// from the reader of recordings/.
/// `settings`: from `resolve_settings` for this scene, which refuses what solve cannot do. The sink is called on this thread.
/// Deterministic; with and without a sink the result is the same bit for bit.
Result solve(const Scene& scene, const Settings& settings);
Result solve(const Scene& scene, const Settings& settings, TraceSink& trace);

}  // namespace gjkdbg
