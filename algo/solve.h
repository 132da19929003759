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
using SupportQueried = gjkdbg::SupportQueried<AnyVector, Viewed>;
using SimplexReduced = gjkdbg::SimplexReduced<AnyVector, Viewed>;
using GjkEnded = gjkdbg::GjkEnded<AnyVector, Viewed>;
using PolytopeSeeded = gjkdbg::PolytopeSeeded<AnyVector, Viewed>;
using FaceChosen = gjkdbg::FaceChosen<AnyVector, Viewed>;
using PolytopeGrown = gjkdbg::PolytopeGrown<AnyVector, Viewed>;
using EpaEnded = gjkdbg::EpaEnded<AnyVector, Viewed>;
using Warning = gjkdbg::Warning<AnyVector, Viewed>;
}  // namespace world

/// A sink whose type is not known to the algorithms: one virtual call an event.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void operator()(const world::GjkBegan&) = 0;
  virtual void operator()(const world::SupportQueried&) = 0;
  virtual void operator()(const world::SimplexReduced&) = 0;
  virtual void operator()(const world::GjkEnded&) = 0;
  virtual void operator()(const world::PolytopeSeeded&) = 0;
  virtual void operator()(const world::FaceChosen&) = 0;
  virtual void operator()(const world::PolytopeGrown&) = 0;
  virtual void operator()(const world::EpaEnded&) = 0;
  virtual void operator()(const world::Warning&) = 0;
};

/// Fills in the defaults for a scene. Throws Error (place: pointer relative to the method, "/name", …) for values out of
/// range and for combinations that do not exist, among them what a later version will bring: methods not built yet,
/// and the queries cast and simulate.
Settings resolve_settings(const Method& method, const Scene& scene);

/// Solves the scene's query for its two bodies. The scene must be valid (`shapes/scene_check.h` or the reader of recordings/).
/// Deterministic; with and without a sink the result is the same bit for bit.
Result solve(const Scene& scene, const Settings& settings);
Result solve(const Scene& scene, const Settings& settings, TraceSink& trace);

}  // namespace gjkdbg
