// check, our own recordings: what they say twice (check_record.cpp, check_record_methods.cpp), and the order of their events (check_order.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "recordings/check_context.h"

namespace gjkdbg {

/// What our own recordings say twice: see check_record.cpp.
class RecordCheck {
 public:
  explicit RecordCheck(CheckContext& context);
  /// After every other check of the event: what those find is nearer to the cause.
  void operator()(const Event& event);
  void result();
  void goes_on(int first) { newest_ = Number{first} - 1; }  ///< a run inside a motion has its vertices numbered from there
  void motion();  ///< the counts of a cast's or a simulation's result

 private:
  using Number = std::int64_t;  ///< of what is counted: a recording may hold any `int`, and what follows one, or a sum of them, is none
  static constexpr double unknown = std::numeric_limits<double>::infinity(), unknowable = std::numeric_limits<double>::quiet_NaN();  // from the events
  void contradiction(const std::string& message);
  void theirs(const Event& event);
  template <class E>
  Number right_iteration(const E& e) const;
  void leads_on(const AnyVector& direction, const AnyVector& from, const char* what, double slack = 1e-12);
  void next_in_line(const char* what, Number number, Number& last);
  bool differ(double said, double right) const;
  bool same_points(const std::vector<ContactPoint>& x, const std::vector<ContactPoint>& y) const;
  void bound(const char* whose, double said, double right);
  void same_bounds(const char* whose, double lower, double upper);
  std::string not_as_asked() const;
  double clearance(const recorded::PortalFound& e) const;
  std::string not_by_this_method() const;
  void nearest_to(std::size_t body, const AnyVector& point, const AnyVector& from);
  void add(const std::vector<recorded::Face>& faces, bool in_line);
  void judge(const recorded::GjkBegan& e);
  void judge(const recorded::VertexKept& e);
  void judge(const recorded::SupportQueried& e);
  void judge(const recorded::SimplexReduced& e);
  void judge(const recorded::GjkEnded& e);
  void judge(const recorded::PolytopeSeeded& e);
  void judge(const recorded::FaceChosen& e);
  void judge(const recorded::PolytopeGrown& e);
  void judge(const recorded::EpaEnded& e);
  void judge(const recorded::MprBegan& e);
  void count_axes(const recorded::SatBegan& e);
  void count_section_axes(const recorded::SatBegan& e);
  void judge(const recorded::PortalFound& e);
  void judge(const recorded::MprEnded& e);
  void judge(const recorded::SatBegan& e);
  void judge(const recorded::AxisTested& e);
  void judge(const recorded::SatEnded& e);
  void judge(const recorded::ClosedFormBegan& e);
  void judge(const recorded::LinesSolved& e);
  void judge(const recorded::ClosedFormEnded& e);
  void judge(const recorded::ProjectionsBegan& e);
  void judge(const recorded::PointPredicted& e);
  void judge(const recorded::PointsProjected& e);
  void judge(const recorded::ProjectionsEnded& e);
  void judge(const recorded::CastBegan& e);
  void judge(const recorded::CastAdvanced& e);
  void judge(const recorded::CastEnded& e) { cast_iterations_ = e.iteration; }
  void judge(const recorded::State&) { responded_ = true; }
  void judge(const recorded::Warning& e);
  template <class E>
  void judge(const E&) {}

  CheckContext& c_;
  const bool ours_;
  AnyVector first_;  ///< the direction GJK says it begins with, until it has
  Number iterations_ = 0, supports_ = 0, newest_ = -1, last_face_ = -1;
  std::set<std::string_view> statuses_;       ///< of the phases that ended
  std::string_view last_status_;              ///< of these
  std::optional<double> nearest_projected_;   ///< how far apart the bodies are by the points projected last
  std::pair<double, double> projected_bounds_;  ///< that they prove, of SAT
  std::set<std::string_view> methods_;        ///< that have begun, GJK aside; and warnings that say why one has not
  Number iteration_ = 0;                      ///< of the phase, so far
  bool counted_ = false;                      ///< whether it was seen to begin
  std::vector<int> simplex_, asked_;          ///< GJK's: kept, and asked for since; newest first
  AnyVector towards_, chosen_normal_, from_interior_;  ///< where the next support leads: from GJK's nearest point, across EPA's face, from MPR's inner point
  AnyVector axis_;                            ///< where the last one led
  AnyVector inside_;                          ///< MPR's inner point
  double cleared_ = 0;                        ///< how far the origin is from the boundary at least, by MPR's portals; -infinity before it is inside, NaN where rounding has a say in it
  AnyVector interior_, newest_w_;             ///< MPR's: towards its inner point, zero where that is next to the origin; the last vertex, empty before any
  bool contact_unknown_ = false;              ///< a simulation has said so
  enum class Portal { none, found, found_last } portal_ = Portal::none;  ///< whether there is one, and nothing after it
  double plane_ = 0;                          ///< the farthest its supports have proven the cores apart
  double lower_ = 0, upper_ = 0;              ///< what the phase knows of the bodies' signed distance, infinite where nothing, NaN where the events do not say
  std::map<int, recorded::Face> faces_;       ///< EPA's, those removed too
  std::set<int> standing_, chosen_;           ///< of these
  double height_ = 0;                         ///< the least along the normals chosen
  double section_slack_ = 0;                  ///< SAT's, of bodies of revolution: how much less the depth may be than the least along its axes
  bool meeting_unseen_ = false;               ///< whether the points that meet are looked for without a trace, after the outline
  bool curved_section_ = false;               ///< whether bodies may have an outline that SAT looks along between two directions
  double outlined_ = unknowable;              ///< what bounds the distance from above so far, by that outline
  std::array<Number, 3> axes_{};              ///< SAT's, by source: how many may still come; of an outline any number
  std::optional<recorded::ClosedFormBegan> segments_;
  std::vector<Edge> pairs_;                   ///< of the bodies that a cast looks at
  Number cast_iteration_ = 0, ray_iteration_ = 0;  ///< so far
  double cast_time_ = 0;
  bool responded_ = false;                    ///< whether bodies move otherwise than the scene says
  std::optional<double> radius_between_;      ///< of motions and meshes: between the vertices' difference and that of the bodies, where every pair has the same
  double radius() const { return radius_between_.value_or(c_.radius); }
  std::optional<int> cast_iterations_;
  AnyVector projected_from_;                  ///< the point last said to be projected; empty before any
};

/// Whether our own events follow one another as our steps do: see check_order.cpp.
class OrderCheck {
 public:
  explicit OrderCheck(CheckContext& context);
  /// After every other check of the event.
  void operator()(const Event& event);

 private:
  CheckContext& c_;
  std::string before_, earlier_;
  bool portal_ = false, casting_ = false;  ///< whether MPR has a portal; whether a cast looks at pairs
};

}  // namespace gjkdbg
