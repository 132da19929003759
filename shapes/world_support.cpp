#include "shapes/world_support.h"

#include <cmath>

#include "shapes/convex.h"

namespace gjkdbg {

struct WorldSupport::Any {
  virtual ~Any() = default;
  virtual AnyVector support(const AnyVector& direction, bool whole) const = 0;
  virtual double radius() const = 0;
};

template <int D>
struct WorldSupport::Of final : WorldSupport::Any {
  Convex<D, double> convex;
  Matrix<D, double> rotation;
  Vector<D, double> position;

  explicit Of(const Body& body) : convex(body.shape), rotation(body.pose.matrix), position(body.pose.position) {}

  AnyVector support(const AnyVector& direction, bool whole) const override {
    Vector<D, double> d = direction;
    if (!d.allFinite()) d.setZero();
    // Solvers ask along directions of any length: those whose squares would overflow or vanish are brought near 1, by a power of two, which rounds nothing.
    if (const double most = d.cwiseAbs().maxCoeff(); most > 0 && (most < 1e-100 || most > 1e100)) {
      const int exponent = std::ilogb(most);
      for (int i = 0; i < D; ++i) d[i] = std::ldexp(d[i], -exponent);
    }
    Vector<D, double> p = rotation * (convex.reference() + convex.support(rotation.transpose() * d)) + position;
    if (whole && convex.radius() > 0 && !d.isZero(0)) p += convex.radius() * d.stableNormalized();
    return p;
  }
  double radius() const override { return convex.radius(); }
};

WorldSupport::WorldSupport(const Body& body, int dimension) {
  if (dimension == 1) of_ = std::make_unique<Of<1>>(body);
  else if (dimension == 2) of_ = std::make_unique<Of<2>>(body);
  else of_ = std::make_unique<Of<3>>(body);
}
WorldSupport::~WorldSupport() = default;
WorldSupport::WorldSupport(WorldSupport&&) noexcept = default;

AnyVector WorldSupport::operator()(const AnyVector& direction, bool whole) const { return of_->support(direction, whole); }
double WorldSupport::radius() const { return of_->radius(); }

}  // namespace gjkdbg
