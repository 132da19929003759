#include "debugger/view/session.h"

#include <algorithm>
#include <cstdlib>

#include "algo/solve.h"
#include "debugger/view/explain.h"
#include "recordings/json_reading.h"
#include "recordings/json_writing.h"
#include "shapes/input_file.h"

namespace gjkdbg {

int iteration_of(const Event& event) {
  return std::visit(
      [](const auto& e) {
        if constexpr (requires { e.iteration; }) return e.iteration;
        else return std::is_same_v<std::decay_t<decltype(e)>, recorded::Warning> ? -1 : 0;
      },
      event);
}

std::size_t runs_at(const Recording& recording, std::size_t step) {
  while (step > 0 && std::holds_alternative<recorded::Warning>(recording.events[step])) --step;
  return step;
}

int phase_of(const Event& event) {
  if (const auto* query = std::get_if<recorded::SupportQueried>(&event)) return query->phase == Phase::seed || query->phase == Phase::epa ? 1 : 0;
  return std::holds_alternative<recorded::PolytopeSeeded>(event) || std::holds_alternative<recorded::FaceChosen>(event) ||
                 std::holds_alternative<recorded::PolytopeGrown>(event) || std::holds_alternative<recorded::EpaEnded>(event)
             ? 1
             : 0;
}

namespace {

/// The same kind of event in the same iteration of the same phase.
bool same_place(const Event& x, const Event& y) {
  return x.index() == y.index() && iteration_of(x) == iteration_of(y) && phase_of(x) == phase_of(y);
}

/// Whether something comes of the runs before it: the bodies move on, touch, are pushed.
bool of_the_motion(const Event& event) {
  return std::holds_alternative<recorded::CastAdvanced>(event) || std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::ContactFound>(event) ||
         std::holds_alternative<recorded::ImpulseApplied>(event);
}

/// An error of the scene as the panel calls things: without the file's path to it.
std::string in_the_panels_words(const Error& e) {
  std::string text = e.message(), who;
  if (e.where().starts_with("/bodies/")) who = body_letter(std::atoi(e.where().c_str() + 8)) + ": ";
  else if (!e.where().starts_with("/method") && e.where() != "/query") return e.line();
  if (text.starts_with("must ")) {
    const std::size_t end = e.where().rfind('/');
    std::string field = e.where().substr(end + 1);
    if (field == "0" || field == "1" || field == "2") {  // "position x"
      const std::size_t begin = e.where().rfind('/', end - 1) + 1;
      field = e.where().substr(begin, end - begin) + " " + "xyz"[field[0] - '0'];
    }
    text = field + " " + text;
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return who + text;
}

/// Throws Error where a file of the scene could not be read again, as a number is beyond all bounds. Points are left out: they have been looked at.
void check_readable(const SceneFile& scene) {
  SceneFile light = scene;
  light.method.initial_simplex.clear();
  for (Body& body : light.scene.bodies)
    if (std::holds_alternative<PointSet>(body.shape.geometry) || std::holds_alternative<Mesh>(body.shape.geometry)) body.shape.geometry = Sphere{1};
  parse_scene(scene_to_json(light).dump(), light.directory);
}

}  // namespace

void Session::open(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  const auto title = [&](const SceneFile& scene) { return scene.scene.name.empty() ? file.filename().string() : scene.scene.name; };
  try {
    const Json json = parse_json(text);
    if (json.is_object() && json.contains("format") && json["format"] == "gjk-recording") {
      Recording read = parse_recording(text, directory_of(file));
      const std::string name = title(read.scene);
      open(std::move(read), name);
    } else {
      SceneFile read = scene_from_json(json, directory_of(file));
      const std::string name = title(read);
      open(std::move(read), name);
    }
  } catch (const Error& e) {
    throw e.in(file.string());
  }
}

void Session::open(SceneFile scene, std::string title) {
  take(record(scene));
  begin(std::move(title));
}

void Session::open(Recording recording, std::string title) {
  if (recording.events.empty()) throw Error("no-events", "holds no events", "/events");
  std::vector<Finding> findings = check(recording);
  take(std::move(recording));
  findings_ = std::move(findings);
  begin(std::move(title));
}

/// What was opened is all there is.
void Session::begin(std::string title) {
  title_ = std::move(title);
  undo_.clear(), redo_.clear(), breakpoints.clear(), bookmarks.clear();
  loop_from.reset(), loop_to.reset(), waiting_.reset();
  stop_comparing();
  playing = false;
  step_ = 0;
  ++opened_;
}

void Session::take(Recording recording) {
  SceneMeshes meshes = scene_meshes(recording.scene.scene, recording.settings);
  // The cursor stays at the event that corresponds: of the same kind and iteration, the same occurrence of it.
  std::optional<Event> place;
  std::size_t occurrence = 0;
  if (replay_ && step_ + 1 < count()) {
    place = recording_.events[step_];
    for (std::size_t i = 0; i < step_; ++i) occurrence += same_place(recording_.events[i], *place);
  }
  const bool at_end = replay_ && step_ + 1 == count();
  replay_.reset();
  findings_.clear();  // what was recorded just now is clean (tested), and checking each would make dragging slow
  recording_ = std::move(recording);
  meshes_ = std::move(meshes);
  replay_.emplace(recording_);
  step_ = at_end ? count() - 1 : std::min(step_, count() - 1);
  if (place) keep_place(*place, occurrence);
  if (other_method_) solve_other();
}

void Session::keep_place(const Event& at, std::size_t occurrence) {
  for (std::size_t i = 0; i < count(); ++i)
    if (same_place(recording_.events[i], at) && occurrence-- == 0) {
      step_ = i;
      return;
    }
}

std::string Session::compare_with(const Method& method, std::string title) {
  try {
    resolve_settings(method, recording_.scene.scene);
    other_method_ = method;
    other_title_ = std::move(title);
    solve_other();
    return {};
  } catch (const Error& e) {
    return in_the_panels_words(e);
  }
}

void Session::go_to(std::size_t step) { step_ = std::min(step, count() - 1); }

void Session::step_by(int events) {
  const auto target = static_cast<long>(step_) + events;
  step_ = static_cast<std::size_t>(std::clamp(target, 0L, static_cast<long>(count()) - 1));
}

void Session::step_iteration(int direction) {
  const auto key = [&](std::size_t i) {
    const Event& event = recording_.events[runs_at(recording_, i)];
    return std::pair(phase_of(event), iteration_of(event));
  };
  const auto from = key(step_);
  const auto stops = [&](std::size_t i) { return i == 0 || i + 1 == count() || key(i) != from; };
  do step_by(direction);
  while (!stops(step_));
  // Backwards: to the first event of the iteration.
  if (direction < 0)
    while (step_ > 0 && key(step_ - 1) == key(step_)) --step_;
}

/// Of a motion, every event that moves it on is a phase of its own.
void Session::step_phase(int direction) {
  const auto phase = [&](std::size_t i) { return phase_of(recording_.events[runs_at(recording_, i)]); };
  const auto own = [&](std::size_t i) { return recording_.scene.scene.motion && of_the_motion(recording_.events[i]); };
  const int from = phase(step_);
  do step_by(direction);
  while (step_ > 0 && step_ + 1 < count() && !own(step_) && phase(step_) == from);
  if (direction < 0)
    while (step_ > 0 && !own(step_) && phase(step_ - 1) == phase(step_)) --step_;
}

void Session::toggle_play() {
  playing = !playing;
  waited_ = 0;
  if (playing && step_ + 1 >= count()) step_ = loop_from.value_or(0);
}

/// To the last state whose time has come.
bool Session::tick_by_the_clock(double seconds) {
  const std::size_t from = step_;
  double now = 0;
  for (std::size_t i = step_ + 1; i-- > 0;)
    if (const auto* state = std::get_if<recorded::State>(&recording_.events[i])) {
      now = state->time;
      break;
    }
  waited_ += seconds * speed;
  std::size_t next = step_;
  for (std::size_t i = step_ + 1; i < count(); ++i) {
    const auto* state = std::get_if<recorded::State>(&recording_.events[i]);
    if (state && state->time > now + waited_) break;
    if (state) next = i;
    if (stops_at(i)) {
      step_ = i, playing = false;
      return true;
    }
  }
  if (next == step_) {
    bool more = false;
    for (std::size_t i = step_ + 1; i < count() && !more; ++i) more = std::holds_alternative<recorded::State>(recording_.events[i]);
    if (!more) step_ = loop ? loop_from.value_or(0) : count() - 1, playing = loop, waited_ = 0;
    return step_ != from;
  }
  waited_ -= std::get<recorded::State>(recording_.events[next]).time - now;
  step_ = next;
  return true;
}

bool Session::tick(double seconds) {
  if (!playing) return false;
  if (plays_by_the_clock()) return tick_by_the_clock(seconds);
  waited_ += seconds * speed * 4;
  bool moved = false;
  while (waited_ >= 1 && playing) {
    waited_ -= 1;
    const std::size_t last = loop_to.value_or(count() - 1);
    if (step_ >= last) {
      if (loop) step_ = loop_from.value_or(0);
      else playing = false;
    } else {
      ++step_;
      if (stops_at(step_)) playing = false;
    }
    moved = true;
  }
  return moved;
}

void Session::toggle_breakpoint() {
  if (breakpoints.erase(step_) == 0) breakpoints.insert(step_);
}

bool Session::add_bookmark() {
  for (int i = 1; i <= 9; ++i)
    if (!bookmarks.contains(i)) return bookmarks[i] = step_, true;
  return false;
}

/// A warm start goes on from the simplex that is shown, as long as its points are of the bodies.
Recording Session::record_from_here(SceneFile next) const {
  if (next.method.start != Start::previous || next.scene.motion) return record(next);
  next.method.initial_simplex = last_simplex(recording_);
  try {
    return record(next);
  } catch (const Error& e) {
    if (!e.where().starts_with("/method/initial_simplex")) throw;
    next.method.initial_simplex.clear();
    return record(next);
  }
}

std::string Session::edit(const SceneFile& next) {
  try {
    for (std::size_t i = 0; i < next.scene.bodies.size(); ++i) {
      try {
        validate(next.scene.bodies[i].shape, next.scene.dimension);
      } catch (const Error& e) {
        // As the panel calls it: "A: half extents must not be negative".
        std::string field = e.where().substr(std::min<std::size_t>(1, e.where().size()));
        field.resize(std::min(field.size(), field.find('/')));
        std::replace(field.begin(), field.end(), '_', ' ');
        return body_letter(static_cast<int>(i)) + ": " + field + (field.empty() ? "" : " ") + e.message();
      }
    }
    check_readable(next);
    Recording recording = record_from_here(next);
    if (!grouping_ || !edit_open_) undo_.push_back(now());
    take(std::move(recording));
    edit_open_ = grouping_;
    redo_.clear();
    return {};
  } catch (const Error& e) {
    return in_the_panels_words(e);
  }
}

SceneFile Session::scene_to_keep() const {
  SceneFile kept = scene();
  std::string& description = kept.scene.description;
  const std::string edited = "edited, from: ";
  if (undo_.empty() || description.empty() || description.starts_with(edited)) return kept;
  const auto described = [](const SceneFile& file) {
    auto json = scene_to_json(file);
    return std::pair(json["bodies"], json["query"]);
  };
  if (described(undo_.front().scene) != described(kept)) description = edited + description;
  return kept;
}

void Session::go_back_to(Past past) {
  std::vector<Finding> findings;
  if (past.run) findings = check(*past.run);
  take(past.run ? std::move(*past.run) : record(past.scene));
  findings_ = std::move(findings);
  go_to(past.step);
}

void Session::undo() {
  if (undo_.empty()) return;
  redo_.push_back(now());
  Past back = std::move(undo_.back());
  undo_.pop_back();
  go_back_to(std::move(back));
}

void Session::redo() {
  if (redo_.empty()) return;
  undo_.push_back(now());
  Past forward = std::move(redo_.back());
  redo_.pop_back();
  go_back_to(std::move(forward));
}

}  // namespace gjkdbg
