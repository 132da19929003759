#include "debugger/view/condition.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <variant>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// What a path leads to: a number or a word.
using Value = std::variant<double, std::string>;

std::optional<Value> part_of(double x, std::string_view part) { return part.empty() ? std::optional<Value>(x) : std::nullopt; }
std::optional<Value> part_of(int x, std::string_view part) { return part_of(static_cast<double>(x), part); }
std::optional<Value> part_of(const Edge& e, std::string_view part) {
  if (part == "first" || part == "second") return static_cast<double>(e[part == "second"]);
  return part.empty() || part == "size" ? std::optional<Value>(2.0) : std::nullopt;
}
std::optional<Value> part_of(const std::string& x, std::string_view part) { return part.empty() ? std::optional<Value>(x) : std::nullopt; }
std::optional<Value> part_of(const AnyVector& v, std::string_view part) {
  if (part.empty() || part == "norm") return v.norm();
  if (part == "size") return static_cast<double>(v.size());
  const auto at = std::string_view("xyz").find(part);
  if (part.size() == 1 && at < static_cast<std::size_t>(v.size())) return v[static_cast<Eigen::Index>(at)];
  return std::nullopt;
}
template <class T>
std::optional<Value> part_of(const std::vector<T>& list, std::string_view part) {
  return part.empty() || part == "size" ? std::optional<Value>(static_cast<double>(list.size())) : std::nullopt;
}
template <class Enum>
  requires std::is_enum_v<Enum>
std::optional<Value> part_of(Enum e, std::string_view part) {
  return part.empty() ? std::optional<Value>(std::string(word_of(e))) : std::nullopt;
}

std::optional<Value> value_of(const Event& event, std::size_t step, std::string_view path) {
  if (path == "step") return static_cast<double>(step);
  if (path == "kind") return std::string(kind_name(event));
  const std::size_t dot = path.find('.');
  const std::string_view name = path.substr(0, dot), part = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  return std::visit(
      [&](const auto& e) {
        std::optional<Value> found;
        const auto one = [&](const auto& f) {
          if (f.name == name) found = part_of(e.*f.member, part);
        };
        std::apply([&](const auto&... f) { (one(f), ...); }, std::decay_t<decltype(e)>::fields());
        return found;
      },
      event);
}

template <std::size_t... I>
bool any_field(std::string_view name, std::index_sequence<I...>) {
  const auto declares = [&]<class E>(const E*) {
    return std::apply([&](const auto&... f) { return ((f.name == name) || ...); }, E::fields());
  };
  return (declares(static_cast<const std::variant_alternative_t<I, Event>*>(nullptr)) || ...);
}
bool is_field(std::string_view path) {
  const std::string_view name = path.substr(0, path.find('.'));
  return name == "kind" || name == "step" || any_field(name, std::make_index_sequence<std::variant_size_v<Event>>());
}

bool compare(const std::string& how, double x, double y) {
  if (how == "<") return x < y;
  if (how == "<=") return x <= y;
  if (how == ">") return x > y;
  if (how == ">=") return x >= y;
  return how == "==" ? x == y : x != y;
}

/// Words, numbers and operators, apart.
std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == ' ' || c == '\t') {
      ++i;
    } else if (std::string_view("<>=!").find(c) != std::string_view::npos) {
      const std::size_t length = i + 1 < text.size() && text[i + 1] == '=' ? 2 : 1;
      tokens.emplace_back(text.substr(i, length));
      i += length;
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t<>=!", i), text.size());
      tokens.emplace_back(text.substr(i, end - i));
      i = end;
    }
  }
  return tokens;
}

bool is_operator(const std::string& token) { return std::string_view("<>=!").find(token[0]) != std::string_view::npos; }

[[noreturn]] void bad(const std::string& why) { throw Error("bad-condition", why, "condition"); }

}  // namespace

Condition::Condition(std::string_view text) : text_(text) {
  const std::vector<std::string> tokens = tokens_of(text);
  if (tokens.empty()) return;
  any_of_.emplace_back();
  for (std::size_t i = 0; i < tokens.size();) {
    Clause clause;
    if (is_operator(tokens[i])) bad("\"" + tokens[i] + "\" needs something before it");
    clause.path = tokens[i++];
    if (clause.path == "any" && i < tokens.size() && (tokens[i] == "warning" || tokens[i] == "finding")) clause.path += " " + tokens[i++];
    if (i < tokens.size() && is_operator(tokens[i])) {
      clause.compare = tokens[i] == "=" ? "==" : tokens[i];
      ++i;
      if (clause.compare == "!" || i >= tokens.size() || is_operator(tokens[i])) bad("\"" + clause.path + " " + clause.compare + "\" needs a number or a word after it");
      if (!is_field(clause.path)) bad("\"" + clause.path + "\" is no field of any event");
      clause.word = tokens[i++];
      const auto [end, error] = std::from_chars(clause.word.data(), clause.word.data() + clause.word.size(), clause.number);
      clause.is_number = error == std::errc() && end == clause.word.data() + clause.word.size();
      if (!clause.is_number && clause.compare != "==" && clause.compare != "!=") bad("\"" + clause.word + "\" is no number: " + clause.compare + " compares numbers");
    }
    any_of_.back().push_back(clause);
    if (i >= tokens.size()) break;
    const std::string& join = tokens[i++];
    if (join == "or" || join == "||") any_of_.emplace_back();
    else if (join != "and" && join != "&&") bad("\"" + join + "\" stands where \"and\" or \"or\" is expected");
    if (i >= tokens.size()) bad("\"" + join + "\" needs something after it");
  }
}

bool Condition::clause_holds(const Clause& clause, const Recording& recording, const std::vector<Finding>& findings, std::size_t step) const {
  const Event& event = recording.events[step];
  const auto found = [&] { return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.step == step; }); };
  if (clause.path == "any finding") return found();
  if (clause.path == "any warning") return std::holds_alternative<recorded::Warning>(event) || found();
  const std::optional<Value> value = value_of(event, step, clause.path);
  if (clause.compare.empty()) return value || kind_name(event).find(clause.path) != std::string_view::npos;
  if (!value) return false;
  if (const double* x = std::get_if<double>(&*value)) return clause.is_number && compare(clause.compare, *x, clause.number);
  const bool same = std::get<std::string>(*value) == clause.word;
  return clause.compare == "==" ? same : clause.compare == "!=" && !same;
}

bool Condition::holds(const Recording& recording, const std::vector<Finding>& findings, std::size_t step) const {
  return std::any_of(any_of_.begin(), any_of_.end(), [&](const std::vector<Clause>& all) {
    return std::all_of(all.begin(), all.end(), [&](const Clause& clause) { return clause_holds(clause, recording, findings, step); });
  });
}

std::optional<std::size_t> find_step(const Condition& condition, const Recording& recording, const std::vector<Finding>& findings, std::size_t from, bool backwards) {
  const std::size_t count = recording.events.size();
  for (std::size_t k = 1; k <= count; ++k) {
    const std::size_t step = backwards ? (from + count - k) % count : (from + k) % count;
    if (condition.holds(recording, findings, step)) return step;
  }
  return std::nullopt;
}

}  // namespace gjkdbg
