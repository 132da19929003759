// What a session has beside the run that is open: another run that it is compared with, and one that waits while a scene is looked at.
#include <algorithm>
#include <cmath>
#include <utility>

#include "debugger/view/session.h"

namespace gjkdbg {

void Session::solve_other() {
  SceneFile scene = recording_.scene;
  scene.method = *other_method_;
  try {
    Recording run = record(scene);
    const std::optional<Method> method = other_method_;
    compare_with(std::move(run), other_title_);
    other_method_ = method;
  } catch (const Error&) {
    stop_comparing();  // the scene has become one that the other method does not take
  }
}

void Session::compare_with(Recording recording, std::string title) {
  if (recording.events.empty()) throw Error("no-events", "holds no events", "/events");
  SceneMeshes meshes = scene_meshes(recording.scene.scene, recording.settings);
  stop_comparing();
  other_ = std::move(recording);
  other_meshes_ = std::move(meshes);
  other_replay_.emplace(other_);
  other_title_ = std::move(title);
  find_parting();
}

namespace {

SharedSupports shared_supports_of(const Recording& a, const Recording& b) {
  const auto supports = [](const Recording& run) {
    std::vector<const AnyVector*> all;
    for (const Event& event : run.events)
      if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) all.push_back(&e->w);
    return all;
  };
  const auto here = supports(a), beside = supports(b);
  const auto same = [](const AnyVector* x, const AnyVector* y) { return x->size() == y->size() && (*x - *y).norm() <= 1e-9 * (x->norm() + y->norm()); };
  const auto first = static_cast<std::size_t>(std::mismatch(here.begin(), here.end(), beside.begin(), beside.end(), same).first - here.begin());
  return {first, first == std::min(here.size(), beside.size())};
}

}  // namespace

void Session::find_parting() {
  parting_.reset();
  unlike_ = false, alike_but_ = "", shared_supports_ = {};
  const std::optional<Difference> any = first_difference(recording_, other_);
  if (!any) return;
  unlike_ = any->event == 0 && recording_.events[0].index() != other_.events[0].index();
  if (unlike_) return;
  parting_ = first_other_step(recording_, other_, any->event);
  if (parting_ && parting_->fields.empty()) shared_supports_ = shared_supports_of(recording_, other_);
  if (parting_ && parting_->event == any->event) return;
  const bool rounding = !any->by.empty() && std::none_of(any->by.begin(), any->by.end(), [](double x) { return std::isnan(x); });
  alike_but_ = rounding ? " but for rounding" : " in what both compute";
}

void Session::stop_comparing() {
  other_replay_.reset();
  other_method_.reset();
  parting_.reset();
  unlike_ = false, alike_but_ = "", shared_supports_ = {};
}

void Session::open_again(Recording recording) {
  if (recording.events.empty()) throw Error("no-events", "holds no events", "/events");
  std::vector<Finding> findings = check(recording);
  take(std::move(recording));
  findings_ = std::move(findings);
  undo_.clear(), redo_.clear();
  playing = false;
  std::erase_if(breakpoints, [&](std::size_t at) { return at >= count(); });
  std::erase_if(bookmarks, [&](const auto& mark) { return mark.second >= count(); });
  if (std::max(loop_from.value_or(0), loop_to.value_or(0)) >= count()) loop_from.reset(), loop_to.reset();
  if (comparing() && !other_method_) find_parting();
}

void Session::swap_compared(std::string title) {
  if (!comparing()) return;
  Recording mine = recording_, theirs = other_;
  if (other_method_ && !foreign(mine)) {
    SceneFile next = mine.scene;
    next.method = *std::exchange(other_method_, std::nullopt);
    if (edit(next).empty()) compare_with(mine.scene.method, std::move(title));  // an edit, which undo takes back
    return;
  }
  const std::size_t step = step_;
  std::string their_title = other_title_;
  open(std::move(theirs), std::move(their_title));
  compare_with(std::move(mine), std::move(title));
  go_to(step);
}

void Session::open_for_a_look(SceneFile scene, std::string title) {
  Recording run = record(scene);  // throws before anything has changed
  std::optional<Waiting> waiting = std::exchange(waiting_, std::nullopt);
  if (!waiting && is_open()) {
    waiting = Waiting{title_, recording_, step_, findings_, undo_, redo_, breakpoints, bookmarks, loop_from, loop_to, {}, other_method_, other_title_};
    if (comparing()) waiting->other = other_;
  }
  take(std::move(run));
  begin(std::move(title));
  waiting_ = std::move(waiting);
}

void Session::take_up_again() {
  if (!waiting_) return;
  Waiting back = *std::exchange(waiting_, std::nullopt);
  take(std::move(back.run));
  begin(std::move(back.title));
  findings_ = std::move(back.findings), undo_ = std::move(back.undo), redo_ = std::move(back.redo);
  breakpoints = std::move(back.breakpoints), bookmarks = std::move(back.bookmarks), loop_from = back.loop_from, loop_to = back.loop_to;
  if (back.other) compare_with(std::move(*back.other), std::move(back.other_title)), other_method_ = std::move(back.other_method);
  go_to(back.step);
}

}  // namespace gjkdbg
