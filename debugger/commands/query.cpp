// query: a scene a line in, a result a line out, in order, in constant memory.
//
// Lines are read in blocks. Each block is cut into as many parts as there are jobs; the parts are answered at the
// same time and written one after the other.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <system_error>
#include <thread>

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

class Queries {
 public:
  std::string input, output;
  int jobs = 1;
  MethodFlags flags;

  int run() {
    std::ifstream file;
    if (input != "-") {
      file = open_input(input);
      directory_ = directory_of(input);
    }
    std::istream& in = input == "-" ? std::cin : file;
    OutputFile out(output);
    std::vector<std::string> lines(block_lines * static_cast<std::size_t>(jobs));
    bool wanted = true;
    while (in && wanted) {
      const std::size_t count = read_block(in, lines);
      for (const Answers& part : answer_block(lines, count)) {
        wanted = wanted && out.write(part.text);
        errors_ += part.errors, missed_ += part.missed;
        if (first_missed_ == 0) first_missed_ = part.first_missed;
        if (first_error_.empty()) first_error_ = part.first_error;
      }
      line_ += count;
      progress(false);
    }
    out.commit();
    progress(true);
    return errors_ > 0 ? exit_bad_input : missed_ > 0 ? exit_difference : exit_done;
  }

 private:
  /// A scene file is one query, however many lines it has.
  std::size_t read_block(std::istream& in, std::vector<std::string>& lines) const {
    if (input.ends_with(".scene.json")) return std::getline(in, lines[0], '\0') ? 1 : 0;
    std::size_t count = 0;
    while (count < lines.size() && std::getline(in, lines[count])) ++count;
    return count;
  }

  std::vector<Answers> answer_block(const std::vector<std::string>& lines, std::size_t count) const {
    const auto parts = static_cast<std::size_t>(jobs);
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
