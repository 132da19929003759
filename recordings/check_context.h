// What the parts of `check` share: the scene's supports, tolerances, the vertices so far, and the findings.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "recordings/check.h"
#include "recordings/check_text.h"
#include "shapes/world_support.h"

namespace gjkdbg {

/// The point nearest the origin of the hull of a few points, and the smallest subset that holds it. By trying all subsets.
struct NearestPoint {
  AnyVector v;
  std::vector<int> subset;  ///< positions in the list
};
NearestPoint nearest_point(const std::vector<AnyVector>& points);

bool contains(const std::vector<int>& list, int x);

class CheckContext {
 public:
  explicit CheckContext(const Recording& r) : CheckContext(r, r, 1) {}
  /// A recording in units of its own (see in_units_of_its_own), the same as it was written, and the unit in lengths of that.
  CheckContext(const Recording& recording, const Recording& written, double unit);

  const Recording& recording;
  const Recording& written;
  const double unit;
  const int dimension;
  std::size_t step = 0;
  std::map<int, AnyVector> vertices;  ///< w by number
  double size = 0;                    ///< the largest length met: what tolerances are relative to
  double world = 0;                   ///< absolute, what coordinates of the world leave of a length of this scene by rounding, however small its bodies are
  double tolerance = 1e-9;            ///< absolute, for positions
  double stop = 1e-6;                 ///< relative: how far apart the bounds may be when a phase says it has converged
  bool has_supports = false;          ///< false for meshes: then only what the recording itself holds is judged
  bool cores = true;                  ///< whether the recorded vertices are those of the cores, or of the whole bodies
  double epsilon() const { return recording.settings.scalar == Scalar::float_precision ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon(); }
  /// How far off our own methods may find the nearest point of these vertices by rounding alone; 0 of other programs' (see check_rounding.cpp).
  double rounding_of(const std::vector<AnyVector>& points) const;
  double digits() const { return recording.settings.scalar == Scalar::float_precision ? 1e-6 : 1e-14; }  ///< what rounding leaves of a length, relative
  double radius = 0;                  ///< between the recorded vertices' difference and the bodies
  std::string unkept;                 ///< where GJK ended apart: what it had in hand and did not keep, though it is nearer; a sentence
  bool last_is_nearest = false;       ///< whether the simplex that GJK ended with is as far from the origin as the bodies are apart
  const bool inferred;                ///< whether the ends of phases were put down by `run`, from what the solver answered

  /// MPR's vertices are of the whole bodies, whatever GJK's and EPA's are of.
  void of_bodies() { cores = radius_ == 0, radius = 0; }
  void of_cores() { cores = told_cores_, radius = told_cores_ ? radius_ : 0; }

  /// max d.w over the difference the vertices are from, divided by |d|.
  double height(const AnyVector& direction) const;
  /// The same over the bodies, radii included.
  double body_height(const AnyVector& direction) const;
  /// The widest gap of the bodies along the direction; negative: how far they overlap along it. Of meshes that of the nearest pair of triangles, and of several as
  /// near that of the one farthest apart along the direction.
  double apart_along(const AnyVector& direction);

  /// What a wrong distance leaves out, or takes off twice: the radii and margins of both bodies, or of one. A sentence, or empty.
  std::string forgotten_radii(double given);

  /// How far a point is from being a support of a body along a unit direction, or of its core: short of it, or beside the body.
  double short_of_support(std::size_t body, const AnyVector& direction, const AnyVector& point) const;

  /// Our own answer to the penetration query, in double precision; computed when first asked for.
  const Result& reference();
  /// The answer to the scene by the recording's own settings, once more: in the lengths it was written in, as it was found.
  Result once_more() const;
  /// How far a claimed distance or depth may be from it.
  double answer_tolerance();

  /// Whether another program's result has the right distance, and the wrong yes or no beside it: these contradict each other, and the search was right.
  bool denies_its_distance();

  /// Adds a finding at this step.
  void find(const char* code, const std::string& message, Finding::Severity severity = Finding::Severity::error);
  /// Of a search that was to stop: where it ends by itself, with the right answer, a warning.
  void find_cost(const char* code, const std::string& message);
  /// The same of a search that went round without coming nearer by more than rounding tells: of our own it is a warning, too.
  void find_stall(const char* code, const std::string& message);
  /// What rounding may have done, to our own: harmless by itself, the likely cause where the answer is wrong.
  void find_unless(bool rounding, const char* code, const std::string& message) { rounding ? suspect(code, message) : find(code, message); }
  /// A warning that is given up where something else is told by this code.
  void mention(const char* code, const std::string& message) { mentioned_.push_back({step, Finding::Severity::warning, code, message}); }
  /// What is harmless by itself, but the likely cause where an answer is wrong later on. The first counts; where the claim of an overlap is wrong, only one of
  /// the simplex that it is made of.
  void suspect(const char* code, const std::string& message);
  /// What explains a wrong answer where nothing better does.
  void doubt(const char* code, const std::string& message) { if (!doubt_) doubt_ = Finding{step, Finding::Severity::error, code, message}; }
  /// EPA's face is not on the boundary, though the depth is right: what else is wrong at the end comes of that.
  void short_of_boundary(const std::string& message) { short_ = Finding{step, Finding::Severity::error, "stopped-early", message}; }
  /// Nothing of the simplex was kept. Once, a search may begin anew; over and over, that is the cause of what goes wrong.
  void reset(const std::string& message);
  /// The finding of this code says itself what it comes of.
  void explained(const char* code) { explained_.insert(code); }
  /// Whether there is a finding of this code so far.
  bool found(const char* code) const { return seen_.contains(code); }
  /// Whether there is one of this step.
  bool found_here() const;
  std::vector<Finding> take();

  /// The position of a vertex; a finding, and nothing, when it was never handed out.
  const AnyVector* vertex(int number);
  bool check_direction(const AnyVector& d);
  /// Of what has not the length 1, digits aside (see check_extent.cpp), a sentence that says so; empty for what has. `whose`: "The normal", …
  std::string not_unit(const AnyVector& normal, const std::string& whose = "The normal") const;
  /// Of a vector off by no more than its own digits: that it was printed with six of them. False for others.
  bool of_few_digits(const AnyVector& given, const AnyVector& right, const std::string& what);
  /// Where a vector is off by no more than single precision leaves of the vertices' places in the world: a sentence that says so.
  std::string lost_far_out(const std::vector<int>& numbers, double off) const;

  /// Ends the warning of a direction that is off in a run that is right.
  static constexpr std::string_view harmless = " Where all else is right this costs iterations, not the answer.";

 private:
  std::optional<std::size_t> last_simplex() const;
  void put_causes_first();
  void soften_what_only_costs();
  std::vector<Finding> told();
  std::optional<Finding> cause_of(const Finding& root) const;
  void tell_what_to_report(Finding& root) const;

  std::optional<WorldSupport> a_, b_;
  std::vector<std::pair<WorldSupport, WorldSupport>> nearest_;  ///< of meshes: the parts as near as the bodies
  double radius_ = 0;       ///< of both bodies
  bool told_cores_ = true;  ///< what `cores` is outside MPR
  std::optional<Result> reference_;
  std::vector<Finding> findings_;
  std::vector<Finding> mentioned_;
  std::set<std::string> seen_, explained_, costs_, stalls_;
  std::optional<Finding> suspicion_, last_suspicion_, doubt_, short_, reset_;
  int resets_ = 0;
};

/// What coordinates of the world leave of a length between the bodies of a scene: see check.cpp.
double rounding_in_the_world(const Scene& scene);
/// How far a point lies outside a body, surely.
double outside(const Scene& scene, std::size_t body, const AnyVector& point);
/// What witnesses that are wrong are instead, a sentence; empty where that is not known.
std::string mistaken_witnesses(CheckContext& context, double slack);

/// Of our own recordings: the one step that the same run once more gives otherwise, or the result. Told unless something is found at that step already; errors found at other
/// steps come of it, and give way to it.
void tell_changed(const Recording& recording, std::vector<Finding>& findings);

/// Yes or no where the bodies touch, or miss it by less than distances are judged by; `best_plane` as in GjkCheck, over the whole recording.
void check_touching(CheckContext& context, double best_plane);

/// What holds for every event: phases end once, numbers are given out once, supports are supports, bounds hold the answer.
class TraceCheck {
 public:
  explicit TraceCheck(CheckContext& context) : c_(context) {}
  /// Before the algorithm's own checks: whether the event may stand here.
  void order(const Event& event);
  /// After them: whether what it says is so.
  void values(const Event& event);
  void finish();

 private:
  void phases(const Event& event);
  void incomplete(const std::string& message);
  void given(int number, bool is_new, const char* what);
  bool belong_together(const AnyVector& a, const AnyVector& b, const AnyVector& w);
  std::string support_hint(std::size_t body, const AnyVector& direction, const AnyVector& point) const;
  std::string beside_body(std::size_t body, double out, bool turned) const;
  double far_out(const AnyVector& a, const AnyVector& b) const;
  void bounds(double lower, double upper);
  void along(const AnyVector& normal, double distance);
  void nearest(const AnyVector& closest, double upper);
  void plane(const std::vector<int>& vertices, const AnyVector& normal, double distance);
  void no_point(const AnyVector& closest);
  void judge(const recorded::ClosedFormBegan& e) { segments_ = e; }
  void judge(const recorded::VertexKept& e);
  void judge(const recorded::SupportQueried& e);
  void judge(const recorded::SimplexReduced& e);
  void judge(const recorded::GjkEnded& e);
  void judge(const recorded::PolytopeGrown& e);
  void judge(const recorded::EpaEnded& e);
  void judge(const recorded::PortalFound& e);
  void judge(const recorded::MprEnded& e);
  void judge(const recorded::AxisTested& e);
  void judge(const recorded::PointsProjected& e);
  void judge(const recorded::SatEnded& e);
  void judge(const recorded::ClosedFormEnded& e);
  void judge(const recorded::ProjectionsEnded& e);
  template <class E>
  void judge(const E&) {}

  CheckContext& c_;
  std::string_view open_, last_ended_;  ///< phases
  std::size_t begun_ = 0;
  bool any_ = false, expandable_ = false, motion_open_ = false, moved_ = false;
  std::set<int> faces_, polytope_;  ///< of all polytopes; of this one, those removed too
  std::optional<recorded::ClosedFormBegan> segments_;
};

/// Directions that come back in the same order, over and over. Fewer times than four may be chance: where a solver reports nothing, GJK's last directions and
/// EPA's first ones stand side by side, and they may well be the same.
class Repetition {
 public:
  static constexpr std::size_t times = 4;
  /// How many directions make up what has now been there `times` times running, and the step at which it was first; unset where nothing has.
  struct Found {
    std::size_t period, first_step;
  };
  std::optional<Found> add(const AnyVector& direction, std::size_t step);
  void forget() { directions_.clear(), steps_.clear(); }

 private:
  std::vector<std::string> directions_;  ///< as keys
  std::vector<std::size_t> steps_;
};

/// GJK's part of a run: directions, simplices, progress, and the claim it ends with.
class GjkCheck {
 public:
  explicit GjkCheck(CheckContext& context) : c_(context), portals_(context.inferred && context.recording.settings.name == MethodName::mpr) {}
  void operator()(const recorded::GjkBegan& e);
  void operator()(const recorded::VertexKept& e) { pending_.insert(pending_.begin(), e.vertex); }
  void operator()(const recorded::SupportQueried& e);
  void operator()(const recorded::SimplexReduced& e);
  void operator()(const recorded::GjkEnded& e);
  double best_plane() const { return best_plane_; }  ///< the greatest distance a support plane has proven, of the vertices' difference

 private:
  std::vector<AnyVector> points(const std::vector<int>& numbers);
  bool goes_on_to_epa() const;
  void check_towards_origin(const AnyVector& direction);
  void check_progress(const recorded::SupportQueried& e);
  bool given_up(int vertex, const std::vector<int>& region);
  void check_region(const recorded::SimplexReduced& e);
  void check_no_more_kept(const std::vector<int>& region, const std::vector<AnyVector>& kept);
  void check_closest(const recorded::SimplexReduced& e);
  void check_cycle(const std::vector<int>& region);
  void check_repetition(const AnyVector& direction);
  bool begins_again(const recorded::SimplexReduced& e);
  void note_unkept(double v, const std::vector<int>& all);
  void check_returned(double v);
  std::string stopping_test(double v, const std::string& nearer) const;
  std::string not_enclosed(const std::vector<int>& simplex, double v);
  bool first_negated(const AnyVector& direction) const;
  bool lost_its_way(std::size_t period) const;
  bool heuristic_region(const std::vector<int>& before, const std::vector<int>& region, const AnyVector& v);

  CheckContext& c_;
  const bool portals_;  ///< whether a solver said to be MPR tells its portals as simplices
  std::vector<int> simplex_, pending_;  ///< kept, and queried since
  bool reported_ = false;               ///< whether any simplex was
  AnyVector first_direction_, last_direction_, told_v_;
  int queries_ = 0;
  int stuck_ = 0;  ///< how often the search went on although nothing had changed
  double best_plane_ = -1e300;
  bool no_nearer_since(std::size_t step);
  struct Reached {
    std::size_t step;
    AnyVector v;
    double rounding;  ///< how far off v may be
  };
  std::vector<Reached> reached_;  ///< by each simplex
  std::map<std::string, std::size_t> regions_;
  std::string last_region_;
  int unasked_ = 0;  ///< how often the simplex was told again with no support since
  std::optional<std::size_t> repeated_from_, repeated_at_;
  Repetition directions_;
};

/// EPA's part.
class EpaCheck {
 public:
  explicit EpaCheck(CheckContext& context) : c_(context) {}
  void operator()(const recorded::SupportQueried& e);
  void operator()(const recorded::PolytopeSeeded& e);
  void operator()(const recorded::FaceChosen& e);
  void operator()(const recorded::PolytopeGrown& e);
  void operator()(const recorded::EpaEnded& e);
  void finish();

 private:
  struct Face {
    std::vector<int> vertices;
    AnyVector normal;      ///< out of the polytope, ours
    double distance = 0;   ///< ours
    double uncertain = 0;  ///< how far off the plane a point of the polytope must be to have a side
    bool usable = true;
  };
  std::string name(int number) const;
  void add(const recorded::Face& f);
  bool supports(const recorded::Face& f, const std::vector<AnyVector>& w) const;
  void orient(const std::vector<recorded::Face>& added);
  bool check_normal(int number, const AnyVector& given);
  void check_plane(int number, const AnyVector& normal, double distance);
  void check_horizon(const recorded::PolytopeGrown& e);
  void check_gain(int newest);
  void tell_no_gain();
  void check_removed(const recorded::PolytopeGrown& e, const std::map<int, Face>& before);
  void check_kept(int newest, const std::vector<int>& removed);
  std::string why_not_grown(const AnyVector& w) const;
  bool check_closed(const std::map<int, Face>& before);
  std::string winding_of(const std::map<int, Face>& faces) const;
  void check_convex(const std::vector<recorded::Face>& added, std::optional<int> newest);
  void check_origin();
  void check_grown_last(const recorded::EpaEnded& e);
  std::vector<std::pair<int, const AnyVector*>> used() const;
  AnyVector centre() const;

  CheckContext& c_;
  std::map<int, Face> faces_;
  std::vector<int> vertices_;                ///< of these, in order, when they were last compared with one another
  std::map<int, std::vector<int>> corners_;  ///< of these, and of those removed
  std::optional<int> chosen_;
  AnyVector chosen_normal_;  ///< as recorded; empty after the query along it
  struct NoGain {
    std::size_t step;
    int vertex, face;
  };
  struct LostFace {
    std::size_t step;
    int number;
    Face face;
  };
  Repetition directions_;          ///< since the polytope last grew
  std::optional<LostFace> lost_;   ///< the face chosen, where the polytope has lost it since
  std::optional<Finding> outside_; ///< the first polytope that the origin is outside of, while none has held it since
  std::optional<NoGain> no_gain_;  ///< the last time the polytope grew by a vertex no farther out than the face chosen
};

/// A number so large that products of four are none, in an event or in the result: see check_extent.cpp. After every other check of it.
void check_extent(CheckContext& context, const Event& event);
void check_extent(CheckContext& context, const Result& result);
/// Before every check of the result: whether its distance is such a number, so that no more than yes or no can be judged.
bool distance_out_of_range(CheckContext& context);
/// The answer against our own, or its yes or no alone.
void check_result(CheckContext& context, double best_plane, bool yes_or_no);
/// A recording of a scene so small that products of its lengths are none, with all of them told in a unit of which they are a few. Nothing for others.
struct InOtherUnits {
  Recording recording;
  double unit;   ///< 2^-exponent
  int exponent;
};
std::optional<InOtherUnits> in_units_of_its_own(const Recording& recording);
/// What was found in such a recording: which unit its numbers are told in.
std::vector<Finding> told_in_units(std::vector<Finding> findings, const InOtherUnits& units);

/// The steps of one run inside a motion, as of a recording of its two bodies at rest: events before `first` stand for nothing.
std::vector<Finding> check_steps(const Recording& run, std::size_t first);
/// Whether the run that a contact comes from came to its limit: GJK's distance along its normal is then less than it says, EPA's points may lie beside the bodies.
struct RunEnds {
  bool gjk_at_limit, epa_at_limit;
};
RunEnds ends_before(const CheckContext& context, std::size_t contact);
/// A contact of a simulation, of two bodies where they are then.
void check_contact(CheckContext& context, const Scene& two, const recorded::ContactFound& contact);
/// Runs of a simulation that came to their limits.
void check_limits(CheckContext& context);
/// The runs of GJK and EPA inside a motion, each by itself.
void check_runs(CheckContext& context);
/// The steps of a cast.
void check_cast_steps(CheckContext& context);
/// A cast: whether bodies meet, when, which, how, and where they end.
void check_cast(CheckContext& context);
/// A simulation: energy, momentum, sinking, and whether states follow from one another.
void check_simulation(CheckContext& context);
/// Whether the scene asks for more than is read of it.
void check_need(CheckContext& context);

}  // namespace gjkdbg
