// query: a scene a line in, a result a line out, in order, in constant memory.
//
// Lines are read in blocks. Each block is cut into as many parts as there are jobs; the parts are answered at the
// same time and written one after the other. Who writes a line to standard input and waits has its answer: a block ends where nothing more is at hand.
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "algo/solve.h"
#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "recordings/comparison.h"
#include "recordings/json_reading.h"
#include "recordings/json_writing.h"
#include "shapes/input_file.h"

namespace gjkdbg {
namespace {

constexpr std::size_t block_lines = 4096;

/// What a part of a block came to.
struct Answers {
  std::string text;
  std::size_t errors = 0, missed = 0, first_missed = 0;  ///< the last: a line
    std::string first_error;                               ///< where, and why
};

/// Of a line that is no JSON as a whole: the first member "id" it has, if that is a value by itself.
std::string broken_id(const std::string& line) {
  try {
    const std::string id = member_text(line, "id");
    return id.empty() || Json::accept(id) ? id : std::string();
  } catch (const Json::exception&) {
    return {};
  }
}

/// The id of a line, which may be broken elsewhere; empty when it has none. What a double cannot hold is taken from the line.
std::string id_of(const Json& json, const std::string& line) {
  if (json.is_null()) return broken_id(line);
  if (!json.is_object()) return {};
  const auto id = json.find("id");
  if (id == json.end()) return {};
  return id->is_number_float() || id->is_structured() ? member_text(line, "id") : id->dump();
}

/// The lines of a file, or of standard input as they come.
class Lines {
 public:
  explicit Lines(const std::string& input) {
    if (input != "-") file_ = open_input(input);
    else standard_ = true;
  }
  bool next(std::string& line) {
    if (!standard_) return static_cast<bool>(std::getline(file_, line));
    while (true) {
      if (const std::size_t end = read_.find('\n', at_); end != std::string::npos) {
        line.assign(read_, at_, end - at_);
        at_ = end + 1;
        return true;
      }
      read_.erase(0, at_), at_ = 0;
      if (ended_) break;
      char chunk[65536];
      const ssize_t n = read(STDIN_FILENO, chunk, sizeof chunk);
      if (n > 0) read_.append(chunk, static_cast<std::size_t>(n));
      else if (n == 0 || errno != EINTR) ended_ = true;
    }
    line = std::exchange(read_, "");
    return !line.empty();
  }
  /// All of it, line ends and all.
  bool whole(std::string& text) { return static_cast<bool>(std::getline(file_, text, '\0')); }
  /// Whether the next line, or the end, need not be waited for.
  bool at_hand() const {
    if (!standard_ || ended_ || read_.find('\n', at_) != std::string::npos) return true;
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    return poll(&waiting, 1, 0) != 0;
  }

 private:
  std::ifstream file_;
  std::string read_;
  std::size_t at_ = 0;
  bool standard_ = false, ended_ = false;
};

class Queries {
 public:
  std::string input, output;
  int jobs = 1;
  MethodFlags flags;

  int run() {
    Lines in(input);
    if (input != "-") directory_ = directory_of(input);
    OutputFile out(output);
    std::vector<std::string> lines(block_lines * static_cast<std::size_t>(jobs));
    for (bool wanted = true; wanted;) {
      const std::size_t count = read_block(in, lines);
      if (count == 0) break;
      for (const Answers& part : answer_block(lines, count)) {
        wanted = wanted && out.write(part.text);
        errors_ += part.errors, missed_ += part.missed;
        if (first_missed_ == 0) first_missed_ = part.first_missed;
        if (first_error_.empty()) first_error_ = part.first_error;
      }
      wanted = wanted && out.flush();
      line_ += count;
      progress(false);
    }
    out.commit();
    progress(true);
    return errors_ > 0 ? exit_bad_input : missed_ > 0 ? exit_difference : exit_done;
  }

 private:
  /// A scene file is one query, however many lines it has.
  std::size_t read_block(Lines& in, std::vector<std::string>& lines) const {
    if (input.ends_with(".scene.json")) return in.whole(lines[0]) ? 1 : 0;
    std::size_t count = 0;
    while (count < lines.size() && (count == 0 || in.at_hand()) && in.next(lines[count])) ++count;
    return count;
  }

  std::vector<Answers> answer_block(const std::vector<std::string>& lines, std::size_t count) const {
    const std::size_t parts = std::min(static_cast<std::size_t>(jobs), count);
    std::vector<Answers> answers(parts);
    std::vector<std::thread> threads;
    const auto work = [&](std::size_t part) {
      for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i) answer(lines[i], line_ + i + 1, answers[part]);
    };
    for (std::size_t part = 1; part < parts; ++part) {
      try {
        threads.emplace_back(work, part);
      } catch (const std::system_error&) {  // no more threads are to be had: this one does what theirs would have done
        work(part);
      }
    }
    work(0);
    for (std::thread& thread : threads) thread.join();
    return answers;
  }

  void answer(const std::string& line, std::size_t number, Answers& answers) const {
    if (line.find_first_not_of(" \t\r") == std::string::npos) return;
    Json json;
    try {
      json = parse_json(line, number);
      const SceneFile scene = scene_from_json(json, directory_);
      const Result result = solve(scene.scene, flags.resolve(scene, ""));
      append_result(answers.text, result, scene.scene.query, id_of(json, line));
      answers.text += '\n';
      if (!scene.expect || missed_expectations(scene, result).empty()) return;
      if (answers.missed++ == 0) answers.first_missed = number;
    } catch (const Error& e) {
      if (answers.errors++ == 0) answers.first_error = e.where().starts_with("line ") ? e.line() : "line " + std::to_string(number) + ": " + e.line();
      append_error(answers.text, id_of(json, line), number, e);
    }
  }

  static void append_error(std::string& out, const std::string& id, std::size_t line, const Error& e) {
    out += "{\"id\":" + (id.empty() ? "null" : id) + ",\"line\":" + std::to_string(line) + ",\"error\":{\"code\":";
    append_string(out, e.code());
    out += ",\"message\":";
    append_string(out, e.message());
    out += ",\"where\":";
    append_string(out, e.where());
    out += "}}\n";
  }

  /// A line on the terminal, at most five times a second; nothing where standard error is no terminal.
  void progress(bool last) {
    if (isatty(STDERR_FILENO) == 0) {
      if (last && errors_ + missed_ > 0) std::cerr << "gjkdbg: " << summary() << "\n";
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!last && now - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = now;
    const double seconds = std::chrono::duration<double>(now - began_).count();
    std::cerr << "\r" << summary() << ", " << static_cast<long>(static_cast<double>(line_) / std::max(seconds, 1e-9)) << " a second\033[K"
              << (last ? "\n" : "") << std::flush;
  }

  /// Of several bad lines the first: file, place, reason; then how many there are.
  std::string summary() const {
    const std::string all = std::to_string(line_) + (line_ == 1 ? " line" : " lines");
    if (errors_ + missed_ == 0) return visible(input) + ": " + all;
    const std::string first = errors_ > 0 ? one_line(first_error_) : "line " + std::to_string(first_missed_) + ": not as expected";
    return visible(input) + ": " + first + " (of " + all + " " + std::to_string(errors_) + " bad, " + std::to_string(missed_) + " not as expected)";
  }

  std::filesystem::path directory_;
  std::size_t line_ = 0, errors_ = 0, missed_ = 0, first_missed_ = 0;
  std::string first_error_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), shown_{};
};

}  // namespace

void add_query(CLI::App& app, Status& status) {
  auto query = std::make_shared<Queries>();
  CLI::App* command = app.add_subcommand("query", "A scene a line in (JSON lines), a result a line out, in order");
  command->add_option("PAIRS", query->input, "file of scenes, one a line; - for standard input; or a *.scene.json")->required()->check(named());
  command->add_option("-o,--output", query->output, "file to write; standard output unless given")->check(named());
  command->add_option("-j,--jobs", query->jobs, "threads (1)")->transform(whole_between(1, 256));
  query->flags.add_to(*command);
  command->callback([query, &status] { status = query->run(); });
}

}  // namespace gjkdbg
