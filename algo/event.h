// What every event is made of: where its lists live, and how it declares its fields.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "algo/status.h"
#include "shapes/vector.h"

namespace gjkdbg {

/// Where an event's lists and texts live: borrowed from the algorithm, or owned by a recording.
struct Viewed {
  template <class T>
  using List = std::span<const T>;
  using Text = std::string_view;
};
struct Owned {
  template <class T>
  using List = std::vector<T>;
  using Text = std::string;
};
template <class Store, class T>
using ListOf = typename Store::template List<T>;

template <class Event, class Member>
struct Field {
  std::string_view name;
  Member Event::*member;
};
template <class Event, class Member>
constexpr Field<Event, Member> field(std::string_view name, Member Event::*member) {
  return {name, member};
}

using Edge = std::array<int, 2>;  ///< the numbers of an edge's two vertices, or of a pair's two bodies

}  // namespace gjkdbg
