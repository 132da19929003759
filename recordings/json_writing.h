// Writing JSON text: numbers so that they read back bit for bit, events one a line.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "algo/result.h"
#include "algo/settings.h"
#include "recordings/recording.h"

namespace gjkdbg {

/// Shortest decimal that reads back to the same double; "null" when not finite; "-0.0" keeps its sign.
void append_number(std::string& out, double x);
void append_vector(std::string& out, const AnyVector& v);  ///< "null" when empty
void append_string(std::string& out, std::string_view text);

/// One event as a JSON object on one line.
void append_event(std::string& out, const Event& event);

/// A result as a JSON object on one line. `id`: JSON text put in front, empty for none.
void append_result(std::string& out, const Result& result, Query query, std::string_view id = {});

/// Every setting as a JSON object on one line.
void append_settings(std::string& out, const Settings& settings);

/// JSON for people: what fits on a line stays on it.
std::string pretty_json(const nlohmann::ordered_json& json, int indent = 0);

}  // namespace gjkdbg
