// What the steps of MPR, SAT, the closed form and the projections mean.
#pragma once

#include "debugger/view/explain_motion.h"

namespace gjkdbg {

struct ExplainMethods : ExplainMotion {
  using ExplainMotion::operator();

  Explanation operator()(const recorded::MprBegan& e) const;
  Explanation operator()(const recorded::PortalFound& e) const;
  Explanation operator()(const recorded::MprEnded& e) const;
  Explanation operator()(const recorded::SatBegan& e) const;
  Explanation operator()(const recorded::AxisTested& e) const;
  Explanation operator()(const recorded::PointsProjected& e) const;
  Explanation operator()(const recorded::SatEnded& e) const;
  Explanation operator()(const recorded::ClosedFormBegan& e) const;
  Explanation operator()(const recorded::ProjectionsBegan& e) const;
  Explanation operator()(const recorded::PointPredicted& e) const;
  Explanation operator()(const recorded::ProjectionsEnded& e) const;
  Explanation operator()(const recorded::LinesSolved& e) const;
  Explanation operator()(const recorded::ClosedFormEnded& e) const;

 protected:
  std::string a() const { return body_letter(frame.pair[0]); }
  std::string b() const { return body_letter(frame.pair[1]); }
  std::string difference() const { return a() + " - " + b(); }
  std::string facet() const { return facet_name(recording); }

 private:
  bool ends_in(MprStatus status) const;  ///< with the next step
  bool boxes() const;
  bool rod() const;
  bool farther(const recorded::PointsProjected& e) const;
  bool gjk_follows() const;
};

}  // namespace gjkdbg
