// What is open: a scene and its recording, the cursor, play, breakpoints, the history of edits. Knows nothing of windows.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "debugger/render/step_pictures.h"
#include "debugger/view/condition.h"
#include "recordings/check.h"
#include "recordings/comparison.h"
#include "recordings/replay.h"

namespace gjkdbg {

/// Of two runs whose events are not of the same kinds one may only put down more: whether they go the same way is told by their supports.
struct SharedSupports {
  std::size_t first = 0;  ///< so many are the same
  bool all = false;       ///< and one of the runs has no more
};

class Session {
 public:
  /// Opens a scene, or a recording as it is. Throws Error; then nothing has changed.
  void open(const std::filesystem::path& file);
  void open(SceneFile scene, std::string title);
  void open(Recording recording, std::string title);
  /// Opens a scene for a look: what was open before waits, with its step, its marks and its history, until `take_up_again` or another opening.
  void open_for_a_look(SceneFile scene, std::string title);
  /// Of what waits; null where nothing does.
  const std::string* waiting_title() const { return waiting_ ? &waiting_->title : nullptr; }
  void take_up_again();

  bool is_open() const { return replay_.has_value(); }
  const std::string& title() const { return title_; }
  const SceneFile& scene() const { return recording_.scene; }
  /// To be saved or copied: where its bodies or its query have been edited the description says so, for it is of the scene as it was.
  SceneFile scene_to_keep() const;
  const Recording& recording() const { return recording_; }
  const Frame& frame() { return replay_->at(step_); }
  const SceneMeshes& meshes() const { return meshes_; }
  /// What `check` finds in the recording, first wrong step first.
  const std::vector<Finding>& findings() const { return findings_; }
  /// Counts what was opened or edited; cameras are fitted anew when `opened` changes.
  int opened() const { return opened_; }

  // --- The cursor -----------------------------------------------------------------------------------------------
  std::size_t step() const { return step_; }
  std::size_t count() const { return recording_.events.size(); }
  void go_to(std::size_t step);
  void step_by(int events);
  void step_iteration(int direction);
  void step_phase(int direction);

  bool playing = false;
  double speed = 1;  ///< times four events a second; in real time, times as fast as life
  bool real_time = true;  ///< of a simulation: play its states by the clock instead of event by event
  bool plays_by_the_clock() const { return real_time && recording_.scene.scene.query == Query::simulate; }
  bool loop = false;
  std::optional<std::size_t> loop_from, loop_to;
  void toggle_play();
  /// Advances while playing; true when the step changed.
  bool tick(double seconds);

  std::set<std::size_t> breakpoints;  ///< playing stops here
  Condition stop_when;                ///< and where this holds
  bool stops_at(std::size_t step) const { return breakpoints.contains(step) || stop_when.holds(recording_, findings_, step); }
  std::map<int, std::size_t> bookmarks;
  void toggle_breakpoint();
  bool add_bookmark();  ///< false: all nine are taken

  // --- Comparing: another run beside this one, at the same step ------------------------------------------------------
  /// A new run of the scene that is open, at the event that corresponds: what it is compared with stays, and breakpoints do. Throws Error.
  void open_again(Recording recording);
  /// The same scene by another method, solved again with every edit. The message of what is wrong; empty when it is shown.
  std::string compare_with(const Method& method, std::string title);
  /// Another recording, as it is.
  void compare_with(Recording recording, std::string title);
  void stop_comparing();
  /// The run beside comes here and this one beside it: the way to the steps of the longer one. `title`: of this one, beside.
  void swap_compared(std::string title);
  bool comparing() const { return other_replay_.has_value(); }
  const Recording& other() const { return other_; }
  const std::string& other_title() const { return other_title_; }
  const SceneMeshes& other_meshes() const { return other_meshes_; }
  /// Which of the other run's steps is beside this one: the same, or its last; beside the last of this run its last, however long it is.
  std::size_t other_step() const { return step_ + 1 == count() ? other_.events.size() - 1 : std::min(step_, other_.events.size() - 1); }
  const Frame& other_frame() { return other_replay_->at(other_step()); }
  /// Where the two part in more than rounding and what one of them alone computes, if they do and go the same way at all.
  const std::optional<Difference>& parting() const { return parting_; }
  /// Whether the two are of algorithms that have no step in common.
  bool unlike() const { return unlike_; }
  const SharedSupports& shared_supports() const { return shared_supports_; }
  /// What differs before they part, or without it: "", " but for rounding", " in what both compute".
  const char* alike_but() const { return alike_but_; }

  // --- Editing: every edit solves again ----------------------------------------------------------------------------
  /// The message of what is wrong with the edited scene; empty when it was taken over.
  std::string edit(const SceneFile& next);
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  void undo();
  void redo();
  /// The next edits count as one until `end_edit`: a drag is undone as a whole.
  void begin_edit() { edit_open_ = false, grouping_ = true; }
  void end_edit() { grouping_ = false; }

 private:
  Recording record_from_here(SceneFile next) const;
  void take(Recording recording);
  void begin(std::string title);
  bool tick_by_the_clock(double seconds);
  void keep_place(const Event& at, std::size_t occurrence);
  void solve_other();
  void find_parting();

  std::string title_;
  Recording recording_;
  std::optional<Replay> replay_;
  SceneMeshes meshes_;
  std::vector<Finding> findings_;
  std::size_t step_ = 0;
  double waited_ = 0;
  int opened_ = 0;
  /// What an edit replaced: another program's run cannot be made again from its scene.
  struct Past {
    SceneFile scene;
    std::optional<Recording> run;
    std::size_t step = 0;
  };
  Past now() const { return {recording_.scene, foreign(recording_) ? std::optional(recording_) : std::nullopt, step_}; }
  void go_back_to(Past past);
  std::vector<Past> undo_, redo_;
  bool grouping_ = false, edit_open_ = false;

  Recording other_;
  std::optional<Replay> other_replay_;
  std::optional<Method> other_method_;
  SceneMeshes other_meshes_;
  std::string other_title_;
  std::optional<Difference> parting_;
  bool unlike_ = false;
  const char* alike_but_ = "";
  SharedSupports shared_supports_;

  struct Waiting {
    std::string title;
    Recording run;
    std::size_t step = 0;
    std::vector<Finding> findings;
    std::vector<Past> undo, redo;
    std::set<std::size_t> breakpoints;
    std::map<int, std::size_t> bookmarks;
    std::optional<std::size_t> loop_from, loop_to;
    std::optional<Recording> other;  ///< that it is compared with
    std::optional<Method> other_method;
    std::string other_title;
  };
  std::optional<Waiting> waiting_;
};

/// The iteration an event belongs to, beginnings to the 0th; -1 for none.
int iteration_of(const Event& event);
/// The event that a step is about: its own, or of a warning the one before it, in whose iteration the warning was given.
std::size_t runs_at(const Recording& recording, std::size_t step);
/// 0 before and in GJK, MPR and SAT, 1 in EPA (its start included), per run.
int phase_of(const Event& event);

}  // namespace gjkdbg
