#include "shapes/world_support.h"

#include <algorithm>
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
  const double scale;  ///< of the shape's lengths while its support is looked for
  Convex<D, double> convex;
  Matrix<D, double> rotation;
  Vector<D, double> position;

  /// The support of an ellipsoid has squares of lengths, which vanish below 1e-154: small shapes are brought near 1, by a power of two. (Below the normal numbers 2^1000
  /// is near enough, and a number.)
  static double scale_of(double size) { return size > 0 && size < 1e-100 ? std::ldexp(1.0, std::min(-std::ilogb(size), 1000)) : 1; }

  explicit Of(const Body& body) : scale(scale_of(size_of(body.shape))), convex(body.shape, scale), rotation(body.pose.matrix), position(body.pose.position) {}

  AnyVector support(const AnyVector& direction, bool whole) const override {
    Vector<D, double> d = direction;
    if (!d.allFinite()) d.setZero();
    // Solvers ask along directions of any length: those whose squares would overflow or vanish are brought near 1, by a power of two, which rounds nothing.
    if (const double most = d.cwiseAbs().maxCoeff(); most > 0 && (most < 1e-100 || most > 1e100)) {
      const int exponent = std::ilogb(most);
      for (int i = 0; i < D; ++i) d[i] = std::ldexp(d[i], -exponent);
    }
    const Vector<D, double> from_position = rotation * (convex.reference() + convex.support(rotation.transpose() * d));
    Vector<D, double> p = from_position / scale + position;
    if (whole && convex.radius() > 0 && !d.isZero(0)) p += radius() * d.stableNormalized();
    return p;
  }
  double radius() const override { return convex.radius() / scale; }
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
