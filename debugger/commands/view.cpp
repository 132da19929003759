// view: the window. render: pictures of steps without a display.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "debugger/render/image_file.h"
#include "debugger/solver/solver_watch.h"
#include "debugger/view/explain.h"
#include "debugger/view/hosts.h"
#include "recordings/json_writing.h"
#include "recordings/scene_file.h"

#include <nlohmann/json.hpp>

namespace gjkdbg {
namespace {

/// Where this user's settings are kept; empty when there is no home.
std::filesystem::path preferences_file() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config != 0) return std::filesystem::path(config) / "gjkdbg" / "window.json";
  if (const char* home = std::getenv("HOME"); home && *home != 0) return std::filesystem::path(home) / ".config" / "gjkdbg" / "window.json";
  return {};
}

Preferences remembered() {
  const std::filesystem::path file = preferences_file();
  std::error_code ignored;
  if (file.empty() || !std::filesystem::is_regular_file(file, ignored)) return {};
  try {
    return preferences_from_text(read_text_file(file));
  } catch (const Error&) {
    return {};  // unreadable: as on the first start
  }
}

void remember(const Preferences& preferences) {
  const std::filesystem::path file = preferences_file();
  if (file.empty()) return;
  try {
    make_folder(file.parent_path().string());
    write_output(file.string(), preferences_to_text(preferences));
  } catch (const Error&) {
    // A home that cannot be written to is no reason to complain when the window closes.
  }
}

/// A folder of our own among the temporary files, gone with this object however its scope is left.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    if (!mkdtemp(path_.data())) throw Error("cannot-write", "no temporary folder can be made", path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_ = (std::filesystem::temp_directory_path() / ("gjkdbg-" + std::string(6, 'X'))).string();  ///< as mkdtemp wants it
};

/// This program with other words, at the same time, what it says of errors into a file where one is named; 0 when it cannot be started.
pid_t start_self(std::vector<std::string> words, const std::string& errors = {}) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (!errors.empty()) posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program_path().c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  return failed == 0 ? child : 0;
}

/// A picture or the replay of what is open, made by this program's own `render` on a copy of the recording: the window's graphics stay as they are.
void render_to(const App& app, const std::string& file) {
  const TemporaryFolder folder;
  const std::string copy = folder.path() + "/" + (app.session.title().empty() ? "picture" : std::filesystem::path(app.session.title()).filename().string()) + ".recording.json";
  write_output(copy, recording_to_text(app.session.recording()));
  std::vector<std::string> words{"gjkdbg", "render", copy, "-o", file};
  if (file.ends_with(".gif")) words.push_back("--all");
  else words.insert(words.end(), {"--step", std::to_string(app.session.step())});
  if (!app.theme.dark) words.push_back("--light");
  const std::string errors = folder.path() + "/errors";
  const pid_t child = start_self(words, errors);
  int status = -1;
  if (child > 0) waitpid(child, &status, 0);
  if (child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::string reason;
  std::getline(std::ifstream(errors), reason);
  if (const std::string who = "gjkdbg: " + file + ": "; reason.starts_with(who)) reason = reason.substr(who.size());
  throw Error("cannot-write", reason.empty() ? "the picture could not be made" : reason, file);
}

std::string save(const App& app, const std::string& file) {
  try {
    if (file.ends_with(".png") || file.ends_with(".svg") || file.ends_with(".gif")) return render_to(app, file), std::string();
    const Recording& recording = app.session.recording();
    const SceneFile scene = app.session.scene_to_keep();
    if (!file.ends_with(".recording.json")) {
      write_output(file, pretty_json(scene_to_json(scene)) + "\n");
    } else if (scene.scene.description == recording.scene.scene.description) {
      write_output(file, recording_to_text(recording));
    } else {
      Recording kept = recording;
      kept.scene = scene;
      write_output(file, recording_to_text(kept));
    }
    return {};
  } catch (const Error& e) {
    return e.line();
  }
}

/// A file that is named can be shown where there is no gallery, as where only the program was copied to.
Gallery gallery_beside(bool named) {
  const std::filesystem::path directory = gallery_directory();
  std::error_code ignored;
  if (named && !std::filesystem::exists(directory / "lessons.json", ignored)) return {directory, {}};
  return read_gallery(directory);
}

/// What is measured beside the window, for as long as it runs, and where to: a signal that ends this program ends it, too. What it measures it writes at its end.
volatile std::sig_atomic_t measuring_child = 0;
char measuring_folder[1024] = {};

void end_measuring(int signal_number) {
  if (measuring_child > 0) kill(static_cast<pid_t>(measuring_child), SIGKILL), rmdir(measuring_folder);
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

/// `gjkdbg chart --quick` or `atlas --quick` beside the window, for its panel.
class Measuring {
 public:
  Measuring() {
    for (const int n : {SIGTERM, SIGINT, SIGHUP})
      if (signal(n, end_measuring) == SIG_IGN) signal(n, SIG_IGN);  // started by nohup
  }
  ~Measuring() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }

  std::optional<std::filesystem::path> operator()(const std::string& what) {
    if (!what.empty()) {
      folder_ = std::make_unique<TemporaryFolder>(), what_ = what;
      child_ = start_self({"gjkdbg", what, "--quick", "-o", folder_->path()});
      std::strncpy(measuring_folder, folder_->path().c_str(), sizeof measuring_folder - 1);
      measuring_child = child_;
      if (child_ <= 0) throw Error("cannot-measure", "the measurement could not be started", what);
      return std::nullopt;
    }
    int status = 0;
    if (waitpid(child_, &status, WNOHANG) == 0) return std::nullopt;
    child_ = 0;
    measuring_child = 0;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error("cannot-measure", "the measurement failed", what_);
    return std::filesystem::path(folder_->path()) / (what_ + ".json");
  }

 private:
  std::unique_ptr<TemporaryFolder> folder_;  ///< until the next one: the window reads from it
  std::string what_;
  pid_t child_ = 0;
};

/// What the window is told of a solver's run.
Refreshed told(SolverWatch& watch, const SolverLimits& limits) {
  SolverWatch::News news = watch.ask();
  Refreshed refreshed{std::move(news.run), std::move(news.error), {}};
  if (!news.since) return refreshed;
  std::string most;
  append_number(most, limits.timeout);
  refreshed.running = "your solver is running (" + std::to_string(static_cast<int>(*news.since)) + " s; after " + most + " it is ended)";
  return refreshed;
}

struct View {
  std::string file, command, beside;
  WindowOptions options;

  int run() {
    if (!file.empty()) options.file = scene_path(file);
    if (!beside.empty()) options.beside = scene_path(beside);
    for (const auto& named : {options.file, options.beside})
      if (!named.empty()) read_text_file(named);  // a wrong name is told where there is no display, too
    options.save = save;
    options.preferences = remembered();
    options.remember = remember;
    const auto measuring = std::make_shared<Measuring>();
    options.measure = [measuring](const std::string& what) { return (*measuring)(what); };
    if (!command.empty()) {
      SceneFile scene = read_scene(options.file.empty() ? gallery_directory() / (options.scene + ".scene.json") : options.file);
      scene.method.name = MethodName::gjk;
      const SolverLimits limits;
      options.refresh = [watch = std::make_shared<SolverWatch>(std::move(scene), command, limits), limits] { return told(*watch, limits); };
    }
    run_window(options, gallery_beside(!file.empty()));
    return exit_done;
  }
};

struct Render {
  std::string file, output, step = "last";
  bool all = false, light = false, window = false;
  int width = 1280, height = 720;
  float scale = 1;
  MethodFlags flags;

  int run() const {
    std::string path = scene_path(file).string();
    if (all && step != "last") throw Error("bad-usage", "--all shows every step", "--step " + step);
    if (all && !output.ends_with(".gif")) throw Error("unknown-format", "--all writes .gif", "-o " + output);
    if (window && output.ends_with(".svg")) throw Error("unknown-format", "--window writes .png, or with --all .gif", "-o " + output);
    std::optional<TemporaryFolder> folder;
    if (flags.given()) path = by_flags(path, folder.emplace().path());
    if (output.ends_with(".svg")) return svg(path);
    Headless host(width, height, scale, gallery_beside(true));
    App& app = host.app();
    app.preferences.dark = !light;
    apply_colours(app.theme, !light);
    app.open_or_throw(path);
    app.left_tab = App::LeftTab::scene;
    if (all) return animation(host);
    if (!output.ends_with(".png")) throw Error("unknown-format", "must end in .png, .svg, or with --all in .gif", "-o " + output);
    app.session.go_to(step_number(app.session.count()));
    app.drop_note();  // nothing has just been done
    write_output(output, png(host));
    return exit_done;
  }

 private:
  /// The recording of a scene by the method asked for, kept in a folder.
  std::string by_flags(const std::string& path, const std::string& in) const {
    const SceneFile scene = read_scene(path);
    std::string name = std::filesystem::path(path).filename().string();
    const std::string recording = in + "/" + name.substr(0, name.find('.')) + ".recording.json";
    write_output(recording, recording_to_text(record(scene, flags.resolve(scene, path))));
    return recording;
  }

  /// From 0, as in the recording's list of events; "last", or negative from the end.
  std::size_t step_number(std::size_t count) const {
    if (step == "last") return count - 1;
    long n = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), n);
    const long last = static_cast<long>(count) - 1;
    if (error != std::errc() || end != step.data() + step.size() || n > last || n < -last - 1)
      throw Error("no-such-step", "must be a number from 0 to " + std::to_string(last) + ", from -1 to " + std::to_string(-last - 1) + " from the end, or last", "--step " + step);
    return static_cast<std::size_t>(n < 0 ? n + last + 1 : n);
  }

  Image drawn(Headless& host) const {
    host.frame(!window);
    host.frame(!window);  // ImGui lays out what it has measured only in the second
    return host.image();
  }
  std::string png(Headless& host) const {
    const Image image = drawn(host);
    return png_bytes(image.width, image.height, image.rgb);
  }

  int animation(Headless& host) const {
    std::vector<std::vector<std::uint8_t>> frames;
    const std::size_t count = host.app().session.count();
    for (std::size_t i = 0; i < count; ++i) {
      host.app().session.go_to(i);
      frames.push_back(drawn(host).rgb);
    }
    write_output(output, gif_bytes(width, height, frames, 60));
    return exit_done;
  }

  /// Both views as vectors, with the step's sentence below.
  int svg(const std::string& path) const {
    Session session;
    session.open(path);
    session.go_to(step_number(session.count()));
    const Palette& palette = light ? light_palette : dark_palette;
    ViewSettings settings;
    settings.body_letters = true;
    const Explanation e = explain(session.recording(), session.frame());
    const std::vector<std::string> lines = svg_lines(e.text, width - 32.0, 12);
    const double w = width / 2.0, line = 16, h = std::max(height / 3.0, height - 44 - line * static_cast<double>(lines.size()));
    const auto hex = [](Colour c) {
      char text[8];
      std::snprintf(text, sizeof text, "#%02x%02x%02x", c.r, c.g, c.b);
      return std::string(text);
    };
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height) +
                      "\" font-family=\"Inter, DejaVu Sans, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"" + hex(palette.view) + "\"/>\n";
    for (const bool world : {true, false}) {
      const double x = world ? 0 : w;
      const Camera camera = world ? fit_world(session.meshes(), session.recording()) : fit_difference(session.meshes(), session.recording());
      const Projection projection(camera, {x, 0, w, h});
      const auto make = world ? world_picture : difference_picture;
      const std::string clip = world ? "world" : "difference";
      out += "<clipPath id=\"" + clip + "\"><rect x=\"" + std::to_string(x) + "\" y=\"0\" width=\"" + std::to_string(w) + "\" height=\"" + std::to_string(h) + "\"/></clipPath>\n<g clip-path=\"url(#" +
             clip + ")\">\n" + to_svg(flatten(make(session.meshes(), session.recording(), session.frame(), settings, palette, projection), projection), 14) + "</g>\n";
    }
    const auto text = [](const std::string& words, double y, Colour colour) {
      FlatItem item;
      item.kind = FlatItem::Kind::label, item.points = {{16, y, 0}}, item.text = words, item.colour = colour;
      return item;
    };
    out += to_svg({text(e.title, h + 8, palette.text)}, 15);
    for (std::size_t i = 0; i < lines.size(); ++i) out += to_svg({text(lines[i], h + 30 + line * static_cast<double>(i), palette.text_soft)}, 12);
    write_output(output, out + "</svg>\n");
    return exit_done;
  }
};

}  // namespace

void add_view(CLI::App& app, Status& status) {
  auto view = std::make_shared<View>();
  CLI::App* command = app.add_subcommand("view", "The window; the gallery when no file is named");
  command->add_option("FILE", view->file, "scene or recording, or the name of a gallery scene")->check(named());
  command->add_option("--exec", view->command, "show this solver's run on the scene, and again whenever its file changes")->check(named());
  command->add_option("--compare", view->beside, "another recording or scene, shown beside it, in step")->check(named());
  command->add_option("--scale", view->options.scale, "size of everything; the monitor's unless given")->check(between(0.5, 4.0));
  command->add_option("--width", view->options.width, "of the window")->transform(whole_between(320, 16384));
  command->add_option("--height", view->options.height, "of the window")->transform(whole_between(240, 16384));
  command->callback([view, &status] { status = view->run(); });
}

void add_render(CLI::App& app, Status& status) {
  auto render = std::make_shared<Render>();
  CLI::App* command = app.add_subcommand("render", "The picture of a step, without a display");
  command->add_option("FILE", render->file, "scene or recording, or the name of a gallery scene")->required()->check(named());
  command->add_option("-o,--output", render->output, ".png, .svg, or with --all .gif")->required()->check(named());
  command->add_option("--step", render->step, "from 0; negative from the end; last unless given");
  command->add_flag("--all", render->all, "the replay as an animation");
  command->add_flag("--light", render->light, "dark on white");
  command->add_flag("--window", render->window, "the whole window, not only the two views");
  command->add_option("--width", render->width, "pixels")->transform(whole_between(64, 8192));
  command->add_option("--height", render->height, "pixels")->transform(whole_between(64, 8192));
  command->add_option("--scale", render->scale, "size of text and marks")->check(between(0.5, 4.0));
  render->flags.add_to(*command);
  command->callback([render, &status] { status = render->run(); });
}

}  // namespace gjkdbg
