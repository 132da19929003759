// Turns a solver's messages into the events of a recording, and infers what it does not say: when GJK ends, which faces a polytope
// lost and gained.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "recordings/json_reading.h"
#include "recordings/recording.h"
#include "shapes/world_support.h"

namespace gjkdbg {

class SolverRecorder {
 public:
  /// Takes no more than so many support queries.
  SolverRecorder(const SceneFile& scene, const Settings& settings, int max_supports);

  /// The first line the solver gets.
  std::string scene_message() const;
  /// Takes a message. Returns the reply, empty for none. Throws Error when the message is not one of the protocol.
  std::string take(const std::string& line);
  bool done() const { return done_; }
  int supports() const { return supports_; }
  bool asks_too_much() const { return asks_too_much_; }
  /// Ends the recording without an answer.
  void abort(const std::string& code, const std::string& message);
  /// Beside a result that stands.
  void warn(const std::string& code, const std::string& message) { recording_.events.push_back(recorded::Warning{code, message}); }
  Recording finish() &&;

 private:
  std::string support(const Json& json);
  void simplex(const Json& json);
  void polytope(const Json& json);
  void face(const Json& json);
  void result(const Json& json);
  void note_unknown_fields(const std::string& type, const Json& json);
  void check_announced(const AnyVector& direction);
  void tell_not_asked(bool searches_on);
  void turn_chosen(const AnyVector& direction);
  double largest() const;
  void check_plane(const recorded::Face& face, const recorded::FaceChosen& given, bool normal_given, bool distance_given);
  bool check_area(const recorded::Face& face);
  double nearest_face() const;
  void begin(const AnyVector& direction);
  void end_gjk(GjkStatus status);
  std::vector<int> vertex_list(const Json& json, const Place& place) const;
  std::vector<int> face_vertices(const Json& json, const Place& place) const;
  recorded::Face make_face(const std::vector<int>& vertices);
  void orient(std::vector<recorded::Face>& faces) const;
  std::string winding() const;
  recorded::Warning unknown(const std::string& what, int vertex) const;
  void grow(const std::set<std::set<int>>& wanted, std::vector<recorded::Face> added);

  Recording recording_;
  WorldSupport a_, b_;
  int dimension_;
  int supports_ = 0, next_face_ = 0, iteration_ = 0, epa_iteration_ = 0;
  const int max_supports_;
  bool asks_too_much_ = false;
  bool began_ = false, gjk_ended_ = false, epa_ = false, done_ = false;
  std::map<int, AnyVector> vertices_;
  std::vector<int> simplex_, pending_;
  AnyVector announced_;                   ///< the direction that the last simplex gave for the next support; empty when none
  std::optional<std::pair<std::size_t, recorded::Warning>> not_asked_;  ///< the support asked for along another one: before which event this belongs, until it is known that GJK goes on
  std::optional<std::size_t> sideless_;   ///< the event of a face chosen that has no side: without a polytope or a normal, and the origin on it
  std::set<std::string> unknown_fields_;  ///< told of already
  std::map<std::set<int>, recorded::Face> faces_;
  std::map<std::set<int>, std::size_t> gone_;  ///< faces removed, and the step at which they were
  std::optional<recorded::Face> chosen_;
};

}  // namespace gjkdbg
