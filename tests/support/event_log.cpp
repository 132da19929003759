#include "tests/support/event_log.h"

#include <sstream>

namespace gjkdbg {
namespace {

struct Line {
  std::ostringstream out;

  void vector(const AnyVector& v) {
    for (const double x : v) out << " " << (x == 0 ? 0 : x);
  }
  void list(const std::vector<int>& numbers) {
    for (const int n : numbers) out << " " << n;
  }
  void operator()(const recorded::GjkBegan& e) { out << "gjk began along", vector(e.direction); }
  void operator()(const recorded::SupportQueried& e) {
    out << "support " << e.vertex << " (" << word_of(e.phase) << ") along", vector(e.direction);
    out << ": w =", vector(e.w);
  }
  void operator()(const recorded::VertexKept& e) { out << "kept " << e.vertex << ": w =", vector(e.w); }
  void operator()(const recorded::SimplexReduced& e) {
    out << "simplex", list(e.before), out << " ->", list(e.region);
    if (e.closest.size() > 0) out << ", v =", vector(e.closest);
  }
  void operator()(const recorded::GjkEnded& e) { out << "gjk ended " << word_of(e.status); }
  void operator()(const recorded::PolytopeSeeded& e) { out << "polytope of", list(e.vertices), out << ", " << e.faces.size() << " faces"; }
  void operator()(const recorded::FaceChosen& e) { out << "face " << e.face << " chosen at " << e.distance; }
  void operator()(const recorded::PolytopeGrown& e) {
    out << "polytope + " << e.vertex << ": -" << e.removed.size() << " +" << e.added.size() << " faces";
  }
  void operator()(const recorded::EpaEnded& e) {
    out << "epa ended " << word_of(e.status) << ": depth " << e.depth << " along", vector(e.normal);
  }
  void operator()(const recorded::MprBegan& e) { out << "mpr began inside at", vector(e.interior); }
  void operator()(const recorded::PortalFound& e) { out << "portal", list(e.vertices), out << " at " << e.distance << " along", vector(e.normal); }
  void operator()(const recorded::MprEnded& e) {
    out << "mpr ended " << word_of(e.status) << ": depth " << e.depth << " along", vector(e.normal);
  }
  void operator()(const recorded::SatBegan& e) { out << "sat began: faces " << e.faces_a << " " << e.faces_b << ", edge pairs " << e.edge_pairs; }
  void operator()(const recorded::AxisTested& e) {
    out << "axis of " << word_of(e.source) << " along", vector(e.direction), out << ": " << e.distance;
  }
  void operator()(const recorded::PointsProjected& e) { out << "points projected:", vector(e.a), vector(e.b); }
  void operator()(const recorded::SatEnded& e) {
    out << "sat ended " << word_of(e.status) << ": " << e.distance << " along", vector(e.normal);
  }
  void operator()(const recorded::ClosedFormBegan& e) { out << "closed form of", vector(e.corner), out << " +", vector(e.edge_a), out << " -", vector(e.edge_b); }
  void operator()(const recorded::LinesSolved& e) { out << "lines nearest at " << e.s << " " << e.t; }
  void operator()(const recorded::ClosedFormEnded& e) {
    out << "closed form ended " << word_of(e.status) << ": v =", vector(e.closest);
  }
  void operator()(const recorded::ProjectionsBegan& e) { out << "projections began at", vector(e.point); }
  void operator()(const recorded::PointPredicted& e) { out << "predicted:", vector(e.point); }
  void operator()(const recorded::ProjectionsEnded& e) { out << "projections ended " << word_of(e.status) << ": " << e.lower_bound << " to " << e.upper_bound; }
  void operator()(const recorded::CastBegan& e) { out << "cast began: " << e.pairs.size() << " pairs"; }
  void operator()(const recorded::CastAdvanced& e) { out << "at " << e.time << " pair " << e.pair[0] << " " << e.pair[1] << " is " << e.distance << " apart"; }
  void operator()(const recorded::CastEnded& e) { out << "cast ended " << word_of(e.status) << " at " << e.time; }
  void operator()(const recorded::State& e) { out << "state at " << e.time << ": energy " << e.energy; }
  void operator()(const recorded::ContactFound& e) { out << "contact " << e.pair[0] << " " << e.pair[1] << " at", vector(e.point); }
  void operator()(const recorded::ImpulseApplied& e) { out << "impulse " << e.pair[0] << " " << e.pair[1] << ":", vector(e.impulse); }
  void operator()(const recorded::Warning& e) { out << "warning " << e.code; }
};

}  // namespace

std::vector<std::string> event_log(const Recording& recording) {
  std::vector<std::string> lines;
  for (const Event& event : recording.events) {
    Line line;
    line.out.precision(4);
    std::visit(line, event);
    lines.push_back(line.out.str());
  }
  return lines;
}

}  // namespace gjkdbg
