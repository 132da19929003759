// Pairs to measure on: the same for every method, from a fixed seed.
#pragma once

#include <string>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

struct ChartFamily {
  std::string name, title;
  std::vector<Scene> scenes;
};

/// `pairs` of each: boxes, hulls, capsules, curved shapes; apart, shallow, deep; random rotations.
std::vector<ChartFamily> chart_families(int pairs);

/// What modelling too much costs: the same pairs, modelled as they need and as they do not.
struct PriceRow {
  std::string what;
  std::vector<Scene> scenes;
  Query query = Query::penetration;
};
std::vector<PriceRow> price_rows(int pairs);

}  // namespace gjkdbg
