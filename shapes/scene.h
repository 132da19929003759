// A scene: bodies, each a convex shape with a pose, and the least that has to be known about them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "shapes/pose.h"
#include "shapes/shape.h"

namespace gjkdbg {

/// What is asked, least first; nothing beyond it is computed.
enum class Query {
  intersect,    ///< yes or no
  distance,     ///< and how far apart, where; 0 when overlapping
  penetration,  ///< signed distance: and how deep, which way out
  contact,      ///< penetration and the contact points
  cast,         ///< time of impact of moving bodies
  simulate      ///< rigid bodies through time
};
inline constexpr std::array<std::string_view, 6> query_names{"intersect", "distance", "penetration",
                                                             "contact",   "cast",     "simulate"};

struct Body {
  std::string name;
  Shape shape;
  Pose pose;
};

/// Something the reader put right and the user should know.
struct SceneWarning {
  std::string code, message;
};

struct Scene {
  std::string name, description, source;
  std::vector<std::string> tags;
  int dimension = 3;
  Query query = Query::penetration;
  std::vector<Body> bodies;
  std::vector<SceneWarning> warnings;  ///< become the recording's first events
};

}  // namespace gjkdbg
