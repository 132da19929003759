#include "recordings/json_reading.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <simdjson.h>

namespace gjkdbg {

void reject(const Place& place, const std::string& code, const std::string& message) { throw Error(code, message, place.pointer()); }

namespace {

std::string line_and_column(std::string_view text, std::size_t byte, std::size_t first_line) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const std::size_t line = first_line + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Past the end of the string that begins at `i`.
std::size_t past_string(std::string_view text, std::size_t i) {
  for (++i; i < text.size() && text[i] != '"'; ++i)
    if (text[i] == '\\') ++i;
  return i + 1;
}

constexpr std::size_t deepest = 64;

/// Where nesting becomes too deep: the byte's number, from 1.
std::size_t too_deep(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') i = past_string(text, i) - 1;
    else if (text[i] == '[' || text[i] == '{') ++depth;
    else if (text[i] == ']' || text[i] == '}') --depth;
    if (depth > deepest) return i + 1;
  }
  return text.size();
}

/// Builds a document as nlohmann's own parser does, but refuses what that lets pass in silence: a field given twice, and nesting so
/// deep that only a hostile file has it.
class JsonBuilder {
 public:
  JsonBuilder(std::string_view text, std::size_t first_line) : text_(text), first_line_(first_line) {}

  using number_integer_t = Json::number_integer_t;
  using number_unsigned_t = Json::number_unsigned_t;
  using number_float_t = Json::number_float_t;
  using string_t = Json::string_t;
  using binary_t = Json::binary_t;

  bool null() { return add(nullptr); }
  bool boolean(bool x) { return add(x); }
  bool number_integer(number_integer_t x) { return add(x); }
  bool number_unsigned(number_unsigned_t x) { return add(x); }
  bool number_float(number_float_t x, const string_t&) { return add(x); }
  bool string(string_t& x) { return add(std::move(x)); }
  bool binary(binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(string_t& name) {
    Json& object = *open_.back();
    keys_.back() = name;
    if (object.contains(name)) throw Error("duplicate-field", "is given twice", pointer());
    member_ = &object[name];
    return true;
  }
  bool parse_error(std::size_t byte, const std::string& token, const Json::exception& e) {
    if (const auto* syntax = dynamic_cast<const nlohmann::json::parse_error*>(&e)) throw *syntax;
    add(nullptr);  // so that the pointer counts it
    throw Error("non-finite", "the number " + token.substr(0, 40) + " is too large", open_.empty() ? line_and_column(text_, byte, first_line_) : pointer());
  }
  Json take() { return std::move(root_); }

 private:
  template <class T>
  bool add(T&& value) {
    place() = std::forward<T>(value);
    return true;
  }
  Json& place() {
    if (open_.empty()) return root_;
    if (open_.back()->is_object()) return *member_;
    open_.back()->push_back(nullptr);
    return open_.back()->back();
  }
  bool open(Json&& empty) {
    if (open_.size() >= deepest) throw Error("too-deep", "is nested too deeply", line_and_column(text_, too_deep(text_), first_line_));
    Json& here = place();
    here = std::move(empty);
    open_.push_back(&here);
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }
  std::string pointer() const {
    const Place root;
    std::string out;
    for (std::size_t i = 0; i < open_.size(); ++i) out += (open_[i]->is_object() ? Place(root, keys_[i]) : Place(root, open_[i]->size() - 1)).pointer();
    return out;
  }

  std::string_view text_;
  std::size_t first_line_;
  Json root_;
  std::vector<Json*> open_;  ///< never moved while open: only the innermost grows
  std::vector<std::string> keys_;  ///< the latest key of each
  Json* member_ = nullptr;
};

/// nlohmann's message without its own number and position: what was wrong, in a few words.
std::string reason(const std::string& what) {
  const std::size_t colon = what.find("syntax error");
  std::string text = colon == std::string::npos ? what.substr(what.find(']') + 2) : what.substr(colon);
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > 200 ? text.substr(0, 200) : text;
}

/// simdjson's document as ours. False when a field is given twice: the careful parser then says so.
bool convert(const simdjson::dom::element& from, Json& to) {
  using Type = simdjson::dom::element_type;
  switch (from.type()) {
    case Type::OBJECT: {
      to = Json::object();
      auto& members = to.get_ref<Json::object_t&>();
      members.reserve(simdjson::dom::object(from).size());
      for (const auto& [key, value] : simdjson::dom::object(from)) {
        for (const auto& member : members)
          if (member.first == key) return false;
        members.emplace_back(std::string(key), Json());
        if (!convert(value, members.back().second)) return false;
      }
      return true;
    }
    case Type::ARRAY: {
      to = Json::array();
      auto& list = to.get_ref<Json::array_t&>();
      const simdjson::dom::array array(from);
      list.reserve(array.size());
      for (const auto& value : array)
        if (!convert(value, list.emplace_back())) return false;
      return true;
    }
    case Type::INT64: return to = int64_t(from), true;
    case Type::UINT64: return to = uint64_t(from), true;
    case Type::DOUBLE: return to = double(from), true;
    case Type::STRING: return to = std::string_view(from), true;
    case Type::BOOL: return to = bool(from), true;
    default: return to = nullptr, true;
  }
}

/// The fast way. False when anything at all is unusual.
bool parse_fast(std::string_view text, Json& json) {
  thread_local simdjson::dom::parser parser(std::size_t{1} << 31);
  simdjson::dom::element document;
  if (parser.parse(text.data(), text.size()).get(document) != simdjson::SUCCESS) return false;
  return convert(document, json);
}

/// The careful way: slower, and able to say what is wrong and where.
Json parse_carefully(std::string_view text, std::size_t first_line = 1) {
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)  // which the parser takes for the end
    throw Error("bad-json", "is no JSON: a NUL byte", line_and_column(text, nul + 1, first_line));
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw Error("bad-json", "is no JSON: there is nothing in it", line_and_column(text, text.size() + 1, first_line));
  try {
    JsonBuilder builder(text, first_line);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
  } catch (const nlohmann::json::parse_error& e) {
    throw Error("bad-json", "is no JSON: " + reason(e.what()), line_and_column(text, e.byte, first_line));
  }
}

}  // namespace

Json parse_json(std::string_view text, std::size_t first_line) {
  Json json;
  return parse_fast(text, json) ? json : parse_carefully(text, first_line);
}

std::string member_text(std::string_view text, std::string_view key) {
  constexpr std::string_view space = " \t\r\n";
  std::string member, value;
  int depth = 0;
  bool in_value = false;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t end = c == '"' ? past_string(text, i) : i + 1;
    const std::string_view word = text.substr(i, end - i);
    i = end;
    if (space.find(c) != std::string_view::npos) continue;
    if (depth == 1 && (c == ',' || c == '}')) {
      if (in_value && member == key) return value;
      in_value = false;
    } else if (depth == 1 && c == ':' && !in_value) {
      in_value = true, value.clear();
    } else if (in_value) {
      value += word;
    } else if (c == '"') {
      member = Json::parse(word).get<std::string>();
    }
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
  }
  return {};
}

namespace {

/// The fast way in parts. False, before anything was handed over, when the document is unusual; elements that are go the careful way.
bool parts_fast(std::string_view text, std::string_view list, const std::function<void(const Json&)>& rest, const std::function<void(std::size_t, const Json&)>& element) {
  simdjson::dom::parser parser(std::size_t{1} << 31);
  simdjson::dom::object document;
  if (parser.parse(text.data(), text.size()).get(document) != simdjson::SUCCESS) return false;
  Json head = Json::object();
  simdjson::dom::array elements;
  bool long_list = false;
  for (const auto& [key, value] : document) {
    if (head.contains(std::string(key))) return false;
    Json& member = head[std::string(key)];
    if (key == list && value.get(elements) == simdjson::SUCCESS) member = Json::array(), long_list = true;
    else if (!convert(value, member)) return false;
  }
  rest(head);
  std::size_t i = 0;
  if (long_list)
    for (const auto& value : elements) {
      Json one;
      if (!convert(value, one)) parse_carefully(text);  // says what is wrong, and where
      element(i++, one);
    }
  return true;
}

}  // namespace

void parse_json_in_parts(std::string_view text, std::string_view list, const std::function<void(const Json&)>& rest, const std::function<void(std::size_t, const Json&)>& element) {
  if (parts_fast(text, list, rest, element)) return;
  Json json = parse_carefully(text);
  const auto found = json.is_object() ? json.find(std::string(list)) : json.end();
  if (!json.is_object() || found == json.end() || !found->is_array()) return rest(json);
  const Json elements = std::move(*found);
  *found = Json::array();
  rest(json);
  for (std::size_t i = 0; i < elements.size(); ++i) element(i, elements[i]);
}

std::string nearest_name(std::string_view word, const std::vector<std::string_view>& candidates, std::size_t one_letter_in) {
  const auto distance = [](std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= b.size(); ++j) {
        const std::size_t above = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
        diagonal = above;
      }
    }
    return row[b.size()];
  };
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / one_letter_in) + 1;
  for (const std::string_view candidate : candidates)
    if (const std::size_t d = distance(word, candidate); d < least && (d < 2 || word.front() == candidate.front())) least = d, best = candidate;  // who errs twice hardly errs at the first letter
  return best;
}

void require_object(const Json& json, const Place& place) {
  if (!json.is_object()) reject(place, "wrong-type", std::string(place.pointer().empty() ? "the top level " : "") + "must be an object, not " + json.type_name());
}

ObjectReader::ObjectReader(const Json& json, const Place& place) : json_(json), place_(place) { require_object(json, place); }

const Json* ObjectReader::optional(std::string_view key) {
  known_.push_back(key);
  const auto found = json_.find(key);
  return found == json_.end() ? nullptr : &*found;
}

const Json& ObjectReader::required(std::string_view key) {
  if (const Json* value = optional(key)) return *value;
  reject(at(key), "missing-field", "is missing");
}

void ObjectReader::finish() {
  for (const char* text : {"name", "description", "source"})
    if (const auto found = json_.find(text); found != json_.end()) read_string(*found, at(text));
  if (const auto tags = json_.find("tags"); tags != json_.end()) read_tags(*tags, at("tags"));
  for (const auto& [key, value] : json_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string near = nearest_name(key, known_);
    reject(at(key), "unknown-field", "is not a known field" + (near.empty() ? std::string() : "; did you mean \"" + near + "\"?"));
  }
}

std::vector<std::string> read_tags(const Json& json, const Place& place) {
  if (!json.is_array()) reject(place, "wrong-type", "must be an array of strings");
  std::vector<std::string> tags;
  for (std::size_t i = 0; i < json.size(); ++i) tags.push_back(read_string(json[i], Place(place, i)));
  return tags;
}

double read_number(const Json& json, const Place& place) {
  if (!json.is_number()) reject(place, "wrong-type", "must be a number");
  const double x = json.get<double>();
  if (!std::isfinite(x)) reject(place, "non-finite", "must be a finite number");
  return x;
}

int read_integer(const Json& json, const Place& place, int low, int high) {
  const double x = read_number(json, place);
  if (x != std::floor(x) || x < low || x > high)
    reject(place, "out-of-range", low == high ? "must be " + std::to_string(low) : "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(x);
}

bool read_bool(const Json& json, const Place& place) {
  if (!json.is_boolean()) reject(place, "wrong-type", "must be true or false");
  return json.get<bool>();
}

std::string read_string(const Json& json, const Place& place) {
  if (!json.is_string()) reject(place, "wrong-type", "must be a string");
  return json.get<std::string>();
}

AnyVector read_vector(const Json& json, const Place& place, int size) {
  const std::string count = size == 0 ? "1 to 3" : std::to_string(size);
  if (!json.is_array()) reject(place, "wrong-type", "must be an array of " + count + " numbers");
  if (size == 0 ? json.empty() || json.size() > 3 : json.size() != static_cast<std::size_t>(size))
    reject(place, "wrong-dimension", "must have " + count + " numbers, not " + std::to_string(json.size()));
  AnyVector v(static_cast<Eigen::Index>(json.size()));
  for (std::size_t i = 0; i < json.size(); ++i) v[static_cast<Eigen::Index>(i)] = read_number(json[i], Place(place, i));
  return v;
}

std::size_t read_name(const Json& json, const Place& place, std::initializer_list<std::string_view> names) {
  return read_enum(json, place, std::vector<std::string_view>(names));
}

}  // namespace gjkdbg
