// Room to work in that is kept from one query to the next.
#pragma once

#include <memory>

namespace gjkdbg {

/// One a thread, so that it stays in the cache and a query allocates nothing. Who asks for it while it is lent (a sink that asks another query in the middle
/// of a run) gets another, for as long as it takes.
template <class Thing>
class Lent {
 public:
  Lent() {
    if (is_lent()) another_ = std::make_unique<Thing>();
    else is_lent() = true;
  }
  ~Lent() {
    if (!another_) is_lent() = false;
  }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

  Thing& operator*() { return another_ ? *another_ : of_this_thread(); }

 private:
  static Thing& of_this_thread() {
    thread_local Thing thing;
    return thing;
  }
  static bool& is_lent() {
    thread_local bool lent = false;
    return lent;
  }

  std::unique_ptr<Thing> another_;
};

}  // namespace gjkdbg
