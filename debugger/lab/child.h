// Work in a process of its own: other people's code may crash or never end, and takes nothing of ours along.
#pragma once

#include <functional>
#include <type_traits>

namespace gjkdbg {

enum class ChildEnd { finished, crashed, timed_out };

/// Runs `work` in a child process and waits; its answer is the `size` bytes it leaves in the buffer handed to it. What the child prints is dropped.
/// Only to be called while this process has one thread.
ChildEnd in_child(double seconds, void* answer, std::size_t size, const std::function<void(void*)>& work);

template <class Answer>
ChildEnd in_child(double seconds, Answer& answer, const std::function<void(Answer&)>& work) {
  static_assert(std::is_trivially_copyable_v<Answer>);
  return in_child(seconds, &answer, sizeof answer, [&](void* place) { work(*static_cast<Answer*>(place)); });
}

}  // namespace gjkdbg
