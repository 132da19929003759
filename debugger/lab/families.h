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

/// `pairs` of each, random rotations, placed by the signed distance: boxes, hulls of 32 to 1,000 vertices, capsules, curved shapes, apart and
/// overlapping; faces that touch within 1e-9, slivers, sizes and places far apart; 2D. Those named, or all; throws Error for a name there is not.
std::vector<ChartFamily> chart_families(int pairs, const std::vector<std::string>& names = {});
/// The names of all, those of a full chart first.
std::vector<std::string> chart_family_names();
/// Hulls of so many vertices around a unit sphere, the gap between them given.
std::vector<Scene> hull_pairs(int pairs, int vertices, double gap);
/// Ellipsoids as in the benchmark of Montaut et al. 2024 (radii of mean 0.1, deviation 0.025), with the gap given.
std::vector<Scene> ladder_ellipsoids(int pairs, double gap);

/// What modelling too much costs: the same pairs, modelled as they need and as they do not.
struct PriceRow {
  std::string what;
  std::vector<Scene> scenes;
  Query query = Query::penetration;
};
std::vector<PriceRow> price_rows(int pairs);

}  // namespace gjkdbg
