// sweep: the gallery and random scenes, or scenes of one's own, through another implementation; what fails, and how, and the simplest scene that fails alike.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "algo/solve.h"
#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "debugger/solver/solver_run.h"
#include "recordings/check.h"
#include "recordings/comparison.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

/// Random pairs of convex polytopes and round shapes, some touching, some deep.
class RandomPairs {
 public:
  RandomPairs(unsigned seed, int dimension) : random_(seed), dimension_(dimension) {}

  SceneFile next(int number) {
    SceneFile file;
    file.scene.name = "random-" + std::to_string(number);
    file.scene.dimension = dimension_ > 0 ? dimension_ : 2 + number % 2;
    for (const char* name : {"A", "B"}) {
      Body body{name, shape(file.scene.dimension), identity_pose(file.scene.dimension)};
      for (double& x : body.pose.position) x = rounded(uniform(-1.5, 1.5));
      file.scene.bodies.push_back(body);
    }
    return file;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// Short numbers: easy to read, and ties are common.
  static double rounded(double x) { return std::nearbyint(x * 8) / 8; }
  Shape shape(int dimension) {
    const int kind = std::uniform_int_distribution<int>(0, 3)(random_);
    if (kind == 0) {
      AnyVector half(dimension);
      for (double& x : half) x = rounded(uniform(0.2, 1)) + 0.125;
      return {Box{-half, half, true}, 0};
    }
    if (kind == 1 && dimension > 1) return {Capsule{0.25, rounded(uniform(0.2, 1)), 0}, 0};
    if (dimension == 1) return {Box{AnyVector::Constant(1, -0.5), AnyVector::Constant(1, 0.5), false}, 0};
    PointSet set;
    set.kind = dimension == 2 ? PointSetKind::polygon : PointSetKind::hull;
    for (int i = 0; i < 4 + kind * 2; ++i) {
      AnyVector p(dimension);
      for (double& x : p) x = rounded(uniform(-1, 1));
      set.points.push_back(p);
    }
    return {set, 0};
  }
  std::mt19937 random_;
  int dimension_;
};

/// What the program writes to its standard error, kept apart from the table. The same traceback a hundred times tells no more than once.
class ErrorOutput {
 public:
  ErrorOutput() : file_(std::tmpfile(), &std::fclose) {}
  int descriptor() const { return file_ ? fileno(file_.get()) : STDERR_FILENO; }
  /// Where it was not shown before.
  void show(const std::string& text) {
    if (text.empty() || !shown_.insert(text).second || shown_.size() > most + 1) return;
    std::cout << (shown_.size() > most ? "  (more error output, not shown; `run` shows what comes of a scene)\n" : indented(text)) << std::flush;
  }
  /// What came since the last call.
  std::string take() {
    std::string text;
    if (!file_) return text;
    std::rewind(file_.get());
    char chunk[4096];
    for (std::size_t n; (n = std::fread(chunk, 1, sizeof chunk, file_.get())) > 0;)
      if (text.size() < longest) text.append(chunk, n);
    std::rewind(file_.get());
    if (ftruncate(fileno(file_.get()), 0) != 0) file_.reset();
    return text;
  }

 private:
  static constexpr std::size_t most = 5, longest = 4000;  ///< texts; characters of one
  static std::string indented(const std::string& text) {
    std::string out, line;
    for (std::istringstream lines(text.substr(0, longest)); std::getline(lines, line);) out += "    " + line + "\n";
    return out;
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::set<std::string> shown_;
};

constexpr const char* unexpected = "expect";  ///< beside the codes of findings

struct Sweep {
  std::string command, output;
  std::vector<std::string> scenes;  ///< files or gallery names; none: all of the gallery
  std::optional<int> random;
  int dimension = 0;
  std::string by;      ///< how the program comes to its directions
  std::string scalar;  ///< what the program counts in, where it is not the scene's
  unsigned seed = 1;
  SolverLimits limits;

  int run() {
    if (std::filesystem::exists(output) && !std::filesystem::is_directory(output)) make_folder(output);  // says that it is none
    ErrorOutput errors;
    limits.errors = errors.descriptor();
    int passed = 0, failed = 0, not_asked = 0;
    std::map<std::string, int> codes;
    const auto one = [&](const SceneFile& scene) {
      if (!suits(scene)) return void(++not_asked);
      const auto code = failure(scene);
      code ? ++failed : ++passed;
      if (!code) return void(errors.take());
      ++codes[*code];
      std::cout << std::left << std::setw(36) << visible(scene.scene.name) << " " << *code;
      const std::string said = errors.take();
      if (!output.empty()) std::cout << "  " << visible(save(scene, *code));
      std::cout << std::endl;
      errors.take();
      errors.show(said);
    };
    for (const SceneFile& scene : chosen()) one(scene);
    RandomPairs pairs(seed, dimension);
    for (int i = 0; i < random.value_or(scenes.empty() ? 100 : 0); ++i) one(pairs.next(i));
    std::cout << "\n" << passed << (passed == 1 ? " scene clean, " : " scenes clean, ") << failed << " not\n";
    if (!scenes.empty() && not_asked > 0) std::cout << not_asked << " not asked: a program is not asked of bodies that move and of meshes" << (dimension > 0 ? ", nor here of other dimensions" : "") << "\n";
    for (const auto& [code, count] : codes) std::cout << "  " << std::setw(30) << code << " " << count << "\n";
    if (failed > 0) std::cout << "What each means, with the numbers: gjkdbg run SCENE --exec ...\n";
    return failed > 0 ? exit_difference : exit_done;
  }

 private:
  /// Read before the first is asked of: a file that is wrong is told at once.
  std::vector<SceneFile> chosen() const {
    std::vector<SceneFile> read;
    for (const std::string& scene : scenes) {
      const std::string file = scene_path(scene).string();
      read.push_back(read_scene(file));
      if (std::string& name = read.back().scene.name; name.empty()) name = std::filesystem::path(file).stem().stem().string();
      try {
        if (suits(read.back())) settings_of(read.back());
      } catch (const Error& e) {
        throw e.in(file);
      }
    }
    if (!scenes.empty()) return read;
    const Gallery gallery = read_gallery(gallery_directory());
    for (const Lesson& lesson : gallery.lessons)
      for (const std::string& name : lesson.scenes) read.push_back(read_scene(gallery.file(name)));
    return read;
  }

  bool suits(const SceneFile& scene) const {
    if (scene.scene.motion || (dimension > 0 && scene.scene.dimension != dimension)) return false;
    for (const Body& body : scene.scene.bodies)
      if (std::holds_alternative<Mesh>(body.shape.geometry)) return false;
    return true;
  }

  Settings settings_of(const SceneFile& scene) const {
    Method method = method_for_solver(scene.method);
    if (by == word_of(MethodName::gjk_accelerated)) method.name = MethodName::gjk_accelerated;
    if (!scalar.empty()) method.scalar = scalar == scalar_names[1] ? Scalar::float_precision : Scalar::double_precision;
    return resolve_settings(method, scene.scene);
  }

  /// The code of the first finding, if any; "expect" where there is none, but the answer is not what the scene expects.
  std::optional<std::string> failure(const SceneFile& scene) const {
    const Recording run = run_solver(scene, settings_of(scene), command, limits);
    if (const auto findings = check(run); !findings.empty()) return findings.front().code;
    return missed_by_solver(scene, run).empty() ? std::nullopt : std::optional<std::string>(unexpected);
  }

  /// Writes the failing scene, shrunk: as long as the first finding stays the same, corners go and numbers lose digits.
  std::string save(SceneFile scene, const std::string& code) {
    const bool as_it_is = code == unexpected;  // another scene has other answers
    if (!as_it_is) scene.expect.reset();
    for (int tries = as_it_is ? 0 : 60; tries > 0;) {
      bool smaller = false;
      for (const SceneFile& next : simpler(scene)) {
        if (--tries < 0) break;
        try {
          for (const Body& body : next.scene.bodies) validate(body.shape, next.scene.dimension);
          if (failure(next) != code) continue;
        } catch (const Error&) {
          continue;
        }
        scene = next;
        smaller = true;
        break;
      }
      if (!smaller) break;
    }
    make_folder(output);
    const std::string name = as_file_name(scene.scene.name);
    const int same = ++saved_[name];  // scenes of different folders may have one name
    const std::string file = (std::filesystem::path(output) / (name + (same > 1 ? "-" + std::to_string(same) : "") + ".scene.json")).string();
    write_output(file, pretty_json(scene_to_json(scene)) + "\n");
    return file;
  }

  /// A scene may be called anything, "../a" too; its file stays in the folder. Not in the middle of a character: the bytes that go on in one are 10xxxxxx.
  static std::string as_file_name(std::string name) {
    std::replace_if(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f || c == '/' || c == '\\'; }, '-');
    if (name.starts_with('.')) name.front() = '-';
    std::size_t length = std::min<std::size_t>(name.size(), 200);
    while (length > 0 && length < name.size() && (static_cast<unsigned char>(name[length]) & 0xC0) == 0x80) --length;
    return name.substr(0, length);
  }

  static std::vector<SceneFile> simpler(const SceneFile& scene) {
    std::vector<SceneFile> out;
    for (std::size_t b = 0; b < 2; ++b) {
      const Body& body = scene.scene.bodies[b];
      if (const auto* set = std::get_if<PointSet>(&body.shape.geometry); set && set->points.size() > 1 && set->kind >= PointSetKind::polygon)
        for (std::size_t i = 0; i < set->points.size(); ++i) {
          out.push_back(scene);
          auto& points = std::get<PointSet>(out.back().scene.bodies[b].shape.geometry).points;
          points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
        }
      if (!body.pose.matrix.isIdentity(0)) {
        out.push_back(scene);
        Pose straight = identity_pose(scene.scene.dimension);
        straight.position = body.pose.position;
        out.back().scene.bodies[b].pose = straight;
      }
      const AnyVector rounded = body.pose.position.array().round();
      if (rounded != body.pose.position) {
        out.push_back(scene);
        out.back().scene.bodies[b].pose.position = rounded;
      }
    }
    return out;
  }

  std::map<std::string, int> saved_;
};

}  // namespace

void add_sweep(CLI::App& app, Status& status) {
  auto options = std::make_shared<Sweep>();
  CLI::App* command = app.add_subcommand("sweep", "The gallery and random scenes, or your own scenes, through your own GJK");
  command->add_option("SCENE", options->scenes, "scene files or gallery names, and no others (the gallery)")->check(named());
  command->add_option("--exec", options->command, "the program, as a shell would start it")->required()->check(named());
  command->add_option("--random", options->random, "how many random scenes (100; with scenes named: none)")->transform(whole_between(0, 1000000));
  command->add_option("--dimension", options->dimension, "only scenes of this dimension")->transform(whole_between(1, 3));
  command->add_option("--seed", options->seed, "of the random scenes (1)")->transform(whole_between(0, 4294967295.0));
  command->add_option("-o,--output", options->output, "folder for the scenes that fail, shrunk")->check(named());
  command->add_option("--method", options->by, "gjk-accelerated: the program leads its directions by momentum (gjk)")->check(one_of({"gjk", "gjk-accelerated"}));
  command->add_option("--scalar", options->scalar, "float: the program counts in single precision (as the scene says)")->check(one_of({"double", "float"}));
  command->add_option("--max-supports,--max_supports", options->limits.max_supports, "support queries a scene (1000)")->transform(whole_between(1, 10000000));
  command->add_option("--timeout", options->limits.timeout, "seconds a scene (10)")->check(between(0.01, 86400.0));
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
