#include "debugger/commands/input.h"

#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <optional>
#include <sstream>

#include "algo/solve.h"
#include "recordings/json_reading.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace fs = std::filesystem;

fs::path program_path() {
  std::error_code ignored;
#ifdef __APPLE__
  std::string buffer(4096, 0);
  auto size = static_cast<std::uint32_t>(buffer.size());
  return _NSGetExecutablePath(buffer.data(), &size) == 0 ? fs::weakly_canonical(buffer.c_str(), ignored) : fs::path();
#else
  return fs::read_symlink("/proc/self/exe", ignored);
#endif
}

fs::path gallery_directory() {
  if (const char* given = std::getenv("GJKDBG_GALLERY"); given && *given) return given;
  std::error_code ignored;
  const fs::path program = program_path();
  const fs::path installed = program.parent_path().parent_path() / "share/gjkdbg/gallery";
  if (!program.empty() && fs::exists(installed, ignored)) return installed;
  return GJKDBG_SOURCE_GALLERY;
}

namespace {

/// The gallery's scene whose name holds the word, the shortest of several; else the one spelt nearly so; or nothing.
std::string similar_scene(const std::string& word) {
  std::vector<std::string> names;
  std::error_code ignored;
  constexpr std::string_view ending = ".scene.json";
  for (const auto& entry : fs::directory_iterator(gallery_directory(), ignored))
    if (const std::string file = entry.path().filename().string(); file.ends_with(ending)) names.push_back(file.substr(0, file.size() - ending.size()));
  std::sort(names.begin(), names.end(), [](const auto& x, const auto& y) { return std::pair(x.size(), x) < std::pair(y.size(), y); });
  const auto holds = std::find_if(names.begin(), names.end(), [&](const std::string& name) { return word.size() > 2 && name.find(word) != std::string::npos; });
  return holds != names.end() ? *holds : nearest_name(word, {names.begin(), names.end()}, 4);
}

}  // namespace

fs::path scene_path(const std::string& argument) {
  std::error_code ignored;
  if (argument == "-") return input_path(argument);
  if (fs::exists(argument, ignored) || argument.find('/') != std::string::npos) return argument;
  const fs::path in_gallery = gallery_directory() / (argument + ".scene.json");
  if (fs::exists(in_gallery, ignored)) return in_gallery;
  if (argument.find('.') == std::string::npos) {
    const std::string near = similar_scene(argument);
    throw Error("missing-file", "is neither a file nor a scene of the gallery, which gjkdbg scenes lists" + (near.empty() ? "" : "; did you mean " + near + "?"), argument);
  }
  return argument;
}

std::string input_path(const std::string& argument) { return argument == "-" ? "/dev/stdin" : argument; }

std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

CLI::Validator named() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("must name something, not \"\"") : std::string(); }, "");
}

namespace {

std::string short_text(double x) {
  std::ostringstream out;
  out << std::setprecision(15) << x;
  return out.str();
}

/// CLI11 reads a number that begins with 0 by eights.
std::optional<double> number_in(const std::string& text, double low, double high) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == 0 && x >= low && x <= high ? std::optional(x) : std::nullopt;
}

}  // namespace

CLI::Validator between(double low, double high) {
  const std::string range = short_text(low) + " to " + short_text(high);
  return CLI::Validator([=](std::string& text) { return number_in(text, low, high) ? std::string() : "must be a number from " + range + ", not " + text; }, "in [" + range + "]");
}

CLI::Validator whole_between(double low, double high) {
  const std::string range = short_text(low) + " to " + short_text(high);
  const auto check = [=](std::string& text) {
    const auto x = number_in(text, low, high);
    if (!x || *x != std::floor(*x)) return "must be a whole number from " + range + ", not " + text;
    text = short_text(*x);
    return std::string();
  };
  return CLI::Validator(check, "in [" + range + "]");
}

CLI::Validator one_of(std::vector<std::string> names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ",") + name;
  const auto check = [names = std::move(names), all](std::string& text) {
    if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
    const std::string near = nearest_name(text, {names.begin(), names.end()});
    return "must be one of " + all + ", not " + text + (near.empty() ? "" : "; did you mean " + near + "?");
  };
  return CLI::Validator(check, "{" + all + "}");
}

namespace {

template <class Names>
CLI::Validator named_in(const Names& names) {
  return one_of({names.begin(), names.end()});
}

template <class Enum, class Names>
void override_name(std::optional<Enum>& setting, const std::optional<std::string>& flag, const Names& names) {
  if (flag) setting = static_cast<Enum>(std::find(names.begin(), names.end(), *flag) - names.begin());
}

}  // namespace

void MethodFlags::add_to(CLI::App& app) {
  const auto group = "Method (overrides the scene's)";
  app.add_option("--name,--method", name_, "algorithm; fastest: whichever the charts show for these bodies")->check(named_in(method_names))->group(group);
  app.add_option("--closest_point,--closest-point", closest_point_, "GJK's closest-point sub-algorithm")->check(named_in(closest_point_names))->group(group);
  app.add_option("--penetration", penetration_, "what runs when the cores overlap")->check(named_in(penetration_names))->group(group);
  app.add_option("--scalar", scalar_, "arithmetic")->check(named_in(scalar_names))->group(group);
  app.add_option("--stopping", stopping_, "GJK's stopping rule")->check(named_in(stopping_names))->group(group);
  app.add_option("--acceleration", acceleration_, "directions of gjk-accelerated")->check(named_in(acceleration_names))->group(group);
  app.add_option("--start", start_, "where GJK begins")->check(named_in(start_names))->group(group);
  app.add_option("--start_from,--start-from", start_from_, "recording with whose last simplex GJK begins")->check(named())->group(group);
  app.add_option("--tolerance", tolerance_, "relative gap of the bounds at which to stop; greater than 0 and less than 1")->check(between(0, 1))->group(group);
  app.add_option("--max_iterations,--max-iterations", max_iterations_, "of each phase (512, and more for polytopes of many corners)")->transform(whole_between(1, 1000000))->group(group);
  app.add_option("--initial_direction,--initial-direction", initial_direction_, "first search direction, e.g. 1,0,0")->delimiter(',')->allow_extra_args(false)->group(group);  // or a scene's name after it is taken for a number
}

void MethodFlags::override_in(Method& method) const {
  std::optional<MethodName> name;
  override_name(name, name_, method_names);
  if (name) change_name(method, *name);
  override_name(method.closest_point, closest_point_, closest_point_names);
  override_name(method.penetration, penetration_, penetration_names);
  override_name(method.scalar, scalar_, scalar_names);
  override_name(method.stopping, stopping_, stopping_names);
  override_name(method.acceleration, acceleration_, acceleration_names);
  override_name(method.start, start_, start_names);
  if (!start_from_.empty() && (!initial_direction_.empty() || (start_ && *start_ != word_of(Start::previous))))
    throw Error("bad-usage", "GJK begins with its simplex, and cannot begin otherwise as well", "--start-from " + start_from_);
  if (!start_from_.empty()) method.start = Start::previous, method.initial_simplex = last_simplex(read_recording(start_from_)), method.initial_direction.reset();
  if (tolerance_) method.tolerance = tolerance_;
  if (max_iterations_) method.max_iterations = max_iterations_;
  if (!initial_direction_.empty()) {
    if (initial_direction_.size() > 3) throw Error("wrong-dimension", "must have as many numbers as the scene's dimension", "--initial_direction");
    AnyVector d(static_cast<Eigen::Index>(initial_direction_.size()));
    std::copy(initial_direction_.begin(), initial_direction_.end(), d.begin());
    method.initial_direction = d;
    if (!start_) method.start = Start::given, method.initial_simplex.clear();
  }
}

bool MethodFlags::given() const {
  return name_ || closest_point_ || penetration_ || scalar_ || stopping_ || acceleration_ || start_ || tolerance_ || max_iterations_ || !start_from_.empty() || !initial_direction_.empty();
}

Settings MethodFlags::resolve(const SceneFile& scene, const std::string& source) const {
  Method method = scene.method;
  override_in(method);
  try {
    return resolve_settings(method, scene.scene);
  } catch (const Error& e) {
    const std::string setting = e.where().starts_with("/method/") ? e.where().substr(8) : "";
    const bool by_flag = (setting == "name" && name_) || (setting == "closest_point" && closest_point_) ||
                         (setting == "penetration" && penetration_) || (setting == "scalar" && scalar_) || (setting == "stopping" && stopping_) ||
                         (setting == "tolerance" && tolerance_) || (setting == "max_iterations" && max_iterations_) ||
                         (setting == "initial_direction" && !initial_direction_.empty()) || (setting == "start" && start_);
    if (!start_from_.empty() && setting.starts_with("initial_simplex")) throw Error(e.code(), "the simplex of " + start_from_ + " does not fit the scene: a vertex " + e.message(), "--start-from");
    const std::string file = source.empty() ? "" : source + ": ";
    throw Error(e.code(), e.message(), file + (by_flag ? "--" + (setting == "name" ? "method" : setting) : e.where()));
  }
}

}  // namespace gjkdbg
