// Strict reading of JSON: every value is checked, and every error says where.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "shapes/error.h"
#include "shapes/vector.h"

namespace gjkdbg {

using Json = nlohmann::ordered_json;

/// Where we are in a document, as a chain up to its root; turned into a JSON pointer only when something is wrong.
class Place {
 public:
  Place() = default;
  Place(const Place& parent, std::string_view key) : parent_(&parent), key_(key) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(static_cast<long>(index)) {}

  std::string pointer() const {
    if (!parent_) return "";
    return parent_->pointer() + "/" + (index_ >= 0 ? std::to_string(index_) : escaped());
  }

 private:
  std::string escaped() const {
    std::string out;
    for (const char c : key_) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
  }
  const Place* parent_ = nullptr;
  std::string_view key_;
  long index_ = -1;
};

[[noreturn]] void reject(const Place& place, const std::string& code, const std::string& message);

/// Parses text; throws Error with "line L, column C", where the text's first line is number `first_line`, or a JSON pointer.
Json parse_json(std::string_view text, std::size_t first_line = 1);

/// The member of an object as it is written in text that `parse_json` took, without the space around words; empty when there is none.
std::string member_text(std::string_view text, std::string_view key);

/// Parses an object whose member `list` may be long: `rest` gets the object with that member emptied (if it is an array), then `element`
/// each of its elements, which are not kept. Throws as parse_json does, and what the two throw.
void parse_json_in_parts(std::string_view text, std::string_view list, const std::function<void(const Json&)>& rest,
                         const std::function<void(std::size_t, const Json&)>& element);

/// The candidate nearest to a word, by edit distance; empty when none is near: at most two letters differ, or one in so many.
std::string nearest_name(std::string_view word, const std::vector<std::string_view>& candidates, std::size_t one_letter_in = 2);

/// What anything may carry.
inline constexpr std::array<std::string_view, 5> note_names{"id", "name", "description", "source", "tags"};

/// An object all of whose fields must be named: at the end `finish` refuses those nobody asked for. The fields `id`, `name`,
/// `description`, `source` and `tags` may stand anywhere.
class ObjectReader {
 public:
  ObjectReader(const Json& json, const Place& place);

  const Json* optional(std::string_view key);
  const Json& required(std::string_view key);
  bool has(std::string_view key) { return json_.contains(key); }
  Place at(std::string_view key) const { return Place(place_, key); }
  const Place& place() const { return place_; }
  void finish();

 private:
  const Json& json_;
  const Place& place_;
  std::vector<std::string_view> known_{note_names.begin(), note_names.end()};
};

void require_object(const Json& json, const Place& place);
double read_number(const Json& json, const Place& place);
int read_integer(const Json& json, const Place& place, int low, int high);
bool read_bool(const Json& json, const Place& place);
std::string read_string(const Json& json, const Place& place);
std::vector<std::string> read_tags(const Json& json, const Place& place);
/// `size` numbers; any count from 1 to 3 when 0.
AnyVector read_vector(const Json& json, const Place& place, int size);
/// The index of a word in a list of names.
std::size_t read_name(const Json& json, const Place& place, std::initializer_list<std::string_view> names);

template <class Names>
std::size_t read_enum(const Json& json, const Place& place, const Names& names) {
  const std::string word = read_string(json, place);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word) return i;
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  reject(place, "unknown-name", "\"" + word + "\" is not one of " + list);
}

struct Method;
/// Settings as a scene or a recording gives them, in a scene of this dimension.
Method read_method(const Json& json, const Place& place, int dimension);

}  // namespace gjkdbg
