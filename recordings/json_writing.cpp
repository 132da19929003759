#include "recordings/json_writing.h"

#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace gjkdbg {

void append_number(std::string& out, double x) {
  if (!std::isfinite(x)) {
    out += "null";
  } else if (x == 0 && std::signbit(x)) {
    out += "-0.0";
  } else {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, x).ptr;
    out.append(text, end);
  }
}

void append_vector(std::string& out, const AnyVector& v) {
  if (v.size() == 0) {
    out += "null";
    return;
  }
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    out += i == 0 ? '[' : ',';
    append_number(out, v[i]);
  }
  out += ']';
}

void append_string(std::string& out, std::string_view text) {
  out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

void append_integer(std::string& out, int x) {
  char text[16];
  out.append(text, std::to_chars(text, text + sizeof text, x).ptr);
}

void append_value(std::string& out, int x) { append_integer(out, x); }
void append_value(std::string& out, double x) { append_number(out, x); }
void append_value(std::string& out, const AnyVector& v) { append_vector(out, v); }
void append_value(std::string& out, const std::string& text) { append_string(out, text); }
void append_value(std::string& out, Phase p) { append_string(out, word_of(p)); }
void append_value(std::string& out, GjkStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, EpaStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, MprStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, CastStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, ClosedFormStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, ProjectionsStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, SatStatus s) { append_string(out, word_of(s)); }
void append_value(std::string& out, AxisSource s) { append_string(out, word_of(s)); }
void append_value(std::string& out, const Edge& e) {
  out += '[';
  append_integer(out, e[0]);
  out += ',';
  append_integer(out, e[1]);
  out += ']';
}
void append_value(std::string& out, const recorded::Face& face);
void append_value(std::string& out, const recorded::BodyState& body);

template <class T>
void append_value(std::string& out, const std::vector<T>& list) {
  out += '[';
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) out += ',';
    append_value(out, list[i]);
  }
  out += ']';
}

void append_key(std::string& out, std::string_view name, bool first = false) {
  if (!first) out += ',';
  out += '"';
  out += name;
  out += "\":";
}

template <class E>
void append_fields(std::string& out, const E& event, bool first) {
  std::apply([&](const auto&... f) { ((append_key(out, f.name, first), append_value(out, event.*f.member), first = false), ...); }, E::fields());
}

void append_value(std::string& out, const recorded::Face& face) {
  out += '{';
  append_fields(out, face, true);
  out += '}';
}
void append_value(std::string& out, const recorded::BodyState& body) {
  out += '{';
  append_fields(out, body, true);
  out += '}';
}

/// What a cast or a simulation answers.
void append_motion(std::string& out, const Result& r, Query query) {
  const auto number = [&](std::string_view name, const std::optional<double>& x) {
    append_key(out, name);
    append_number(out, x.value_or(NAN));
  };
  number("time", r.time);
  if (query == Query::cast) {
    number("touching_at", r.touching_at);
    append_key(out, "pair");
    if (r.pair) append_value(out, Edge{(*r.pair)[0], (*r.pair)[1]});
    else out += "null";
  } else {
    number("energy", r.energy);
  }
  if (!r.bodies) return;
  append_key(out, "bodies");
  out += '[';
  for (std::size_t i = 0; i < r.bodies->size(); ++i) {
    const FinalState& b = (*r.bodies)[i];
    if (i > 0) out += ',';
    append_value(out, recorded::BodyState{b.position, b.orientation, b.velocity, b.angular_velocity});
  }
  out += ']';
}

}  // namespace

void append_event(std::string& out, const Event& event) {
  std::visit(
      [&](const auto& e) {
        out += "{\"kind\":\"";
        out += e.kind;
        out += '"';
        append_fields(out, e, false);
        out += '}';
      },
      event);
}

void append_result(std::string& out, const Result& r, Query query, std::string_view id) {
  out += '{';
  if (!id.empty()) {
    append_key(out, "id", true);
    out += id;
  }
  append_key(out, "intersecting", id.empty());
  out += unanswered(r) ? "null" : r.intersecting ? "true" : "false";
  const auto number = [&](std::string_view name, const std::optional<double>& x) {
    append_key(out, name);
    append_number(out, x.value_or(NAN));
  };
  const auto vector = [&](std::string_view name, const std::optional<AnyVector>& v) {
    append_key(out, name);
    append_vector(out, v.value_or(AnyVector()));
  };
  const bool moves = query == Query::cast || query == Query::simulate;
  if (moves) append_motion(out, r, query);
  if (query != Query::intersect && query != Query::simulate) {
    if (!moves) number("signed_distance", r.signed_distance);
    vector("normal", r.normal);
    vector("witness_a", r.witness_a);
    vector("witness_b", r.witness_b);
  }
  if (query != Query::intersect && !moves) {
    number("lower_bound", r.lower_bound);
    number("upper_bound", r.upper_bound);
  }
  if (r.contacts) {
    append_key(out, "contacts");
    out += '[';
    for (std::size_t i = 0; i < r.contacts->size(); ++i) {
      const ContactPoint& c = (*r.contacts)[i];
      out += i == 0 ? "{\"point_a\":" : ",{\"point_a\":";
      append_vector(out, c.point_a);
      append_key(out, "point_b");
      append_vector(out, c.point_b);
      append_key(out, "depth");
      append_number(out, c.depth);
      out += '}';
    }
    out += ']';
  }
  append_key(out, "status");
  append_string(out, r.status);
  append_key(out, "iterations");
  append_integer(out, r.iterations);
  append_key(out, "support_calls");
  append_integer(out, r.support_calls);
  out += '}';
}

void append_settings(std::string& out, const Settings& s) {
  const auto name = [&](std::string_view key, std::string_view value, bool first) {
    append_key(out, key, first);
    append_string(out, value);
  };
  out += '{';
  name("name", word_of(s.name), true);
  name("closest_point", word_of(s.closest_point), false);
  name("penetration", word_of(s.penetration), false);
  name("scalar", word_of(s.scalar), false);
  name("stopping", word_of(s.stopping), false);
  name("acceleration", word_of(s.acceleration), false);
  append_key(out, "tolerance");
  append_number(out, s.tolerance);
  append_key(out, "max_iterations");
  append_integer(out, s.max_iterations);
  append_key(out, "initial_direction");
  append_vector(out, s.initial_direction.value_or(AnyVector()));
  name("start", word_of(s.start), false);
  if (!s.initial_simplex.empty()) append_key(out, "initial_simplex");
  for (std::size_t i = 0; i < s.initial_simplex.size(); ++i) {
    out += i == 0 ? "[{" : ",{";
    append_key(out, "a", true);
    append_vector(out, s.initial_simplex[i].a);
    append_key(out, "b");
    append_vector(out, s.initial_simplex[i].b);
    out += '}';
  }
  if (!s.initial_simplex.empty()) out += ']';
  out += '}';
}

std::string pretty_json(const nlohmann::ordered_json& json, int indent) {
  constexpr std::size_t line_width = 110;
  const std::string inner(static_cast<std::size_t>(indent) + 2, ' ');
  std::string compact = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!json.is_structured() || json.empty() || compact.size() + inner.size() <= line_width) return compact;
  std::string out(1, json.is_object() ? '{' : '[');
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    out += first ? "\n" + inner : ",\n" + inner;
    first = false;
    if (json.is_object()) append_string(out, key), out += ": ";
    out += pretty_json(value, indent + 2);
  }
  return out + "\n" + std::string(static_cast<std::size_t>(indent), ' ') + (json.is_object() ? "}" : "]");
}

std::string recording_to_text(const Recording& recording) {
  std::string out = "{\"format\": \"gjk-recording\", \"version\": 1, \"generator\": ";
  append_string(out, recording.generator);
  out += ",\n\"scene\": " + pretty_json(scene_to_json(recording.scene, MeshNotation::in_place));
  out += ",\n\"method\": ";
  append_settings(out, recording.settings);
  out += ",\n\"events\": [";
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    out += i == 0 ? "\n" : ",\n";
    append_event(out, recording.events[i]);
  }
  out += "\n],\n\"result\": ";
  append_result(out, recording.result, recording.scene.scene.query);
  out += "}\n";
  return out;
}

}  // namespace gjkdbg
