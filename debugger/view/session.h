// What is open: a scene and its recording, the cursor, play, breakpoints, the history of edits. Knows nothing of windows.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "debugger/render/step_pictures.h"
#include "recordings/check.h"
#include "recordings/replay.h"

namespace gjkdbg {

class Session {
 public:
  /// Opens a scene, or a recording as it is. Throws Error; then nothing has changed.
  void open(const std::filesystem::path& file);
  void open(SceneFile scene, std::string title);
  void open(Recording recording, std::string title);

  bool is_open() const { return replay_.has_value(); }
  const std::string& title() const { return title_; }
  const SceneFile& scene() const { return recording_.scene; }
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
  double speed = 1;  ///< times four events a second
  bool loop = false;
  std::optional<std::size_t> loop_from, loop_to;
  void toggle_play();
  /// Advances while playing; true when the step changed.
  bool tick(double seconds);

  std::set<std::size_t> breakpoints;  ///< playing stops here
  std::map<int, std::size_t> bookmarks;
  void toggle_breakpoint();
  void add_bookmark();

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
  void take(Recording recording);

  std::string title_;
  Recording recording_;
  std::optional<Replay> replay_;
  SceneMeshes meshes_;
  std::vector<Finding> findings_;
  std::size_t step_ = 0;
  double waited_ = 0;
  int opened_ = 0;
  std::vector<SceneFile> undo_, redo_;
  bool grouping_ = false, edit_open_ = false;
};

/// The iteration an event belongs to, beginnings to the 0th; -1 for none.
int iteration_of(const Event& event);
/// 0 before and in GJK, 1 in EPA (its start included), per run.
int phase_of(const Event& event);

}  // namespace gjkdbg
