#include "algo/prepared_pair.h"

#include "algo/box_query.h"
#include "algo/closed_form.h"
#include "algo/polygon_query.h"
#include "algo/solve_pair.h"
#include "shapes/convex.h"

namespace gjkdbg {
namespace {

template <int D, class S>
class Prepared final : public PreparedPair {
 public:
  Prepared(const Body& a, const Body& b, double scale)
      : pose_a_(a.pose), pose_b_(b.pose), scale_(scale), a_(a.shape, scale), b_(b.shape, scale), segment_a_(core_segment(a_)), segment_b_(core_segment(b_)),
        features_a_(a.shape, D), features_b_(b.shape, D) {
    boxes_ = BoxQuery<D, S>::of(a_, b_, scale);
    if constexpr (D == 2)
      if (PolygonQuery<S>::answers(a_, b_)) polygons_.emplace(a_, b_, scale);
  }

  Result run(const Settings& settings, Query query) override {
    if (settings.name == MethodName::sat && query >= Query::penetration && settings.penetration != Penetration::none) {
      if (boxes_) return answered_by(*boxes_, settings, query);
      if constexpr (D == 2)
        if (polygons_) return answered_by(*polygons_, settings, query);
    }
    return of_pair(settings, query);
  }
  std::vector<SimplexPoint> simplex() const override { return simplex_points(warm_, a_, b_, scale_); }
  void place(const Pose& a, const Pose& b) override { pose_a_ = a, pose_b_ = b; }

 private:
  template <class Pair>
  Result answered_by(const Pair& pair, const Settings& settings, Query query) {
    Result result;
    if (!pair.solve(pose_a_, pose_b_, result)) result = of_pair(settings, query);
    return result;
  }
  Result of_pair(const Settings& settings, Query query) {
    NoTrace trace;
    if (settings.name == MethodName::closed_form)
      return ClosedForm<D, S, NoTrace>(segment_a_.value(), segment_b_.value(), pose_a_, pose_b_, scale_, WorkingFrame<D, S>(pose_a_, scale_), trace).run(query);
    if (settings.start == Start::previous && warm_.size == 0) warm_ = warm_start<D, S>(settings.core_simplex, a_, b_, scale_);
    return PairSolver<D, S, NoTrace>(a_, b_, pose_a_, pose_b_, scale_, settings, trace, &features_a_, &features_b_, &warm_).run(query);
  }

  // What every query looks at, and what is all that some look at, side by side.
  PlacedAxes<D> pose_a_, pose_b_;
  double scale_;
  std::optional<BoxQuery<D, S>> boxes_;
  std::conditional_t<D == 2, std::optional<PolygonQuery<S>>, std::monostate> polygons_;
  Convex<D, S> a_, b_;
  std::optional<CoreSegment<D>> segment_a_, segment_b_;  ///< of the closed form
  WarmStart<D, S> warm_;
  LateFeatures features_a_, features_b_;
};

template <int D>
std::unique_ptr<PreparedPair> prepare_in(const Body& a, const Body& b, Scalar scalar, double scale) {
  if (scalar == Scalar::float_precision) return std::make_unique<Prepared<D, float>>(a, b, scale);
  return std::make_unique<Prepared<D, double>>(a, b, scale);
}

}  // namespace

std::unique_ptr<PreparedPair> prepare(const Body& a, const Body& b, int dimension, Scalar scalar, double scale) {
  if (dimension == 1) return prepare_in<1>(a, b, scalar, scale);
  if (dimension == 2) return prepare_in<2>(a, b, scalar, scale);
  return prepare_in<3>(a, b, scalar, scale);
}

}  // namespace gjkdbg
