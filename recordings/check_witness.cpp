// check, witnesses that are wrong: what they are instead.
#include <algorithm>
#include <numeric>

#include "recordings/check_context.h"
#include "recordings/region_tests.h"

namespace gjkdbg {
namespace {

struct Witnesses {
  CheckContext& c;
  double slack;
  const Result& r = c.recording.result;
  const Result& right = c.reference();
  double distance = r.signed_distance.value_or(*right.signed_distance);
  AnyVector normal = r.normal.value_or(*right.normal);
  double exact = std::max(c.tolerance, 1e-6 * c.size);  ///< a point is the same as another

  bool same(const AnyVector& x, const AnyVector& y) const { return AnyVector(x - y).stableNorm() <= exact + c.digits() * (x.stableNorm() + y.stableNorm()); }
  const std::optional<AnyVector>& told(std::size_t body) const { return body == 0 ? r.witness_a : r.witness_b; }

  /// Not on its body, or its partner across the gap is not on the other.
  bool is_wrong(std::size_t body) const {
    if (!told(body)) return false;
    const AnyVector partner = *told(body) + (body == 0 ? 1 : -1) * distance * normal;
    return outside(c.recording.scene.scene, body, *told(body)) > slack || outside(c.recording.scene.scene, 1 - body, partner) > slack;
  }

  static std::string name(std::size_t body) { return body == 0 ? "witness_a" : "witness_b"; }
  static std::string letter(std::size_t body) { return body == 0 ? "A" : "B"; }

  std::string one_point() const {
    if (!r.witness_a || !r.witness_b || std::abs(distance) <= slack || !same(*r.witness_a, *r.witness_b)) return "";
    return "Both are the same point, but the bodies are " + text_of(std::abs(distance)) + (distance > 0 ? " apart" : " deep") + ": one has been taken for both.";
  }

  /// A point of the difference: the nearest, or what is told to be.
  std::string of_the_difference(std::size_t body) const {
    std::vector<AnyVector> nearest{-distance * normal};
    for (const Event& event : c.recording.events)
      if (const auto* e = std::get_if<recorded::SimplexReduced>(&event); e && e->closest.size() > 0 && e->closest.allFinite()) nearest.resize(1, e->closest), nearest.push_back(e->closest);
    for (const AnyVector& v : nearest)
      if (v.norm() > slack && same(*told(body), v))
        return name(body) + " is v = " + text_of(v) + ", a point of A - B, and none of " + letter(body) + ": the weights that make v of the vertices' w make the witnesses of their a and b.";
    return "";
  }

  std::string both_of_one_vertex() const {
    for (const Event& event : c.recording.events)
      if (const auto vertex = given_vertex(event); vertex && r.witness_a && r.witness_b && same(*r.witness_a, vertex->a) && same(*r.witness_b, vertex->b))
        return "They are the two points of vertex " + std::to_string(vertex->vertex) + " alone, where the weighted sums of the points of all the vertices of the nearest part are due.";
    return "";
  }

  std::string of_one_vertex(std::size_t body) const {
    for (const Event& event : c.recording.events)
      if (const auto vertex = given_vertex(event); vertex && same(*told(body), body == 0 ? vertex->a : vertex->b))
        return name(body) + " is the point of " + letter(body) + " of vertex " + std::to_string(vertex->vertex) + " alone, where the weighted sum of the points of all the vertices of the nearest part is due.";
    return "";
  }

  /// Of the face that EPA chose last, or else the simplex that GJK kept last.
  std::vector<int> last_part() const {
    std::map<int, std::vector<int>> faces;
    std::vector<int> part;
    for (const Event& event : c.recording.events) {
      if (const auto* seeded = std::get_if<recorded::PolytopeSeeded>(&event))
        for (const auto& f : seeded->faces) faces[f.face] = f.vertices;
      if (const auto* grown = std::get_if<recorded::PolytopeGrown>(&event))
        for (const auto& f : grown->added) faces[f.face] = f.vertices;
      if (const auto* reduced = std::get_if<recorded::SimplexReduced>(&event)) part = reduced->region;
      if (const auto* chosen = std::get_if<recorded::FaceChosen>(&event)) part = faces.contains(chosen->face) ? faces[chosen->face] : std::vector<int>();
    }
    return part;
  }

  /// The points of the last part, summed with its own weights in another order, or with none.
  std::string of_other_weights() const {
    const std::vector<int> part = last_part();
    std::vector<AnyVector> w, a, b;
    for (const int number : part)
      for (const Event& event : c.recording.events)
        if (const auto vertex = given_vertex(event); vertex && vertex->vertex == number) w.push_back(vertex->w), a.push_back(vertex->a), b.push_back(vertex->b);
    if (w.size() != part.size() || w.size() < 2 || w.size() > 4) return "";
    std::vector<double> weights;
    for (const RegionTest& test : region_tests(w))
      if (test.part.size() == w.size()) weights = test.weights;
    if (weights.size() != w.size()) return "";
    const auto told_by = [&](const std::vector<double>& by) {
      for (const std::size_t body : {std::size_t{0}, std::size_t{1}}) {
        AnyVector sum = AnyVector::Zero(c.dimension);
        for (std::size_t i = 0; i < w.size(); ++i) sum += by[i] * (body == 0 ? a : b)[i];
        if (told(body) && !same(*told(body), sum)) return false;
      }
      return true;
    };
    const auto text = [](const std::vector<double>& by) {
      std::string out = "(";
      for (const double x : by) out += (out.size() > 1 ? ", " : "") + text_of(x);
      return out + ")";
    };
    if (told_by(weights)) return "";  // of another part, then
    std::vector<std::size_t> order(w.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    while (std::next_permutation(order.begin(), order.end())) {
      std::vector<double> by;
      for (const std::size_t i : order) by.push_back(weights[i]);
      if (told_by(by)) return "They are the sums of the points of " + list_of(part) + " with the weights " + text(by) + ", but the weights are " + text(weights) + " in this order: each belongs to another vertex.";
    }
    if (told_by(std::vector<double>(w.size(), 1.0 / static_cast<double>(w.size())))) return "They are the mean of the points of " + list_of(part) + ", but the weights are " + text(weights) + ".";
    return "";
  }
};

}  // namespace

std::string mistaken_witnesses(CheckContext& context, double slack) {
  if (!context.has_supports || !context.reference().normal) return "";
  const Witnesses witnesses{context, slack};
  std::string known = witnesses.one_point();
  if (known.empty()) known = witnesses.of_other_weights();
  for (const std::size_t body : {std::size_t{0}, std::size_t{1}}) {
    if (!known.empty() || !witnesses.is_wrong(body)) continue;
    known = witnesses.of_the_difference(body);
    if (known.empty()) known = witnesses.both_of_one_vertex();
    if (known.empty()) known = witnesses.of_one_vertex(body);
  }
  if (known.empty()) known = witnesses.both_of_one_vertex();  // each may have a partner on the other body, which the other one is not
  return known;
}

}  // namespace gjkdbg
