#include "debugger/solver/solver_run.h"

#include "debugger/solver/solver_process.h"
#include "debugger/solver/solver_recorder.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

std::string shortened(const std::string& line) {
  std::string out;
  for (const char c : line.substr(0, 120)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (line.size() > 120 ? "..." : "");
}

bool blank(const std::string& line) { return line.find_first_not_of(" \t\r") == std::string::npos; }

/// The last line needs no end.
bool completed_by(SolverRecorder& recorder, const std::string& rest) {
  if (blank(rest)) return false;
  try {
    recorder.take(rest);
  } catch (const Error&) {
    return false;
  }
  return recorder.done();
}

/// Of what it said on its standard error, which is passed on as it comes.
std::string last_words(SolverProcess& process) {
  const std::string words = process.last_words();
  return words.empty() ? "" : " Its last words: " + shortened(words);
}

/// The program has closed its output: it ended, or soon will.
void ended(SolverProcess& process, SolverRecorder& recorder, SolverProcess::Deadline deadline, const std::string& rest) {
  const auto how = process.wait(std::min(deadline, std::chrono::steady_clock::now() + std::chrono::seconds(2)));
  const std::string after = " after " + std::to_string(recorder.supports()) + " support queries";
  if (how && !how->empty()) return recorder.abort("crash", "The solver ended with " + *how + after + ", before it gave a result." + last_words(process));
  const std::string what = how ? "The solver ended" : "The solver closed its output";
  if (!rest.empty()) return recorder.abort("bad-message", what + " in the middle of a line: " + shortened(rest));
  recorder.abort("no-result", what + after + " without a \"result\" message. Print it last, and flush the output.");
}

/// The result is the last message. Its maker may take what comes after for the answer.
void nothing_follows(SolverProcess& process, SolverRecorder& recorder, SolverProcess::Deadline deadline) {
  std::string line;
  SolverProcess::Outcome got;
  do got = process.read_line(line, deadline);
  while (got == SolverProcess::Outcome::ok && blank(line));
  const bool said = got == SolverProcess::Outcome::ok || got == SolverProcess::Outcome::too_long || !blank(line);
  if (said) recorder.warn("bad-message", "The solver gave its result, which is the last message, and went on: " + shortened(line) + " What comes after the result is not read.");
}

void talk(SolverProcess& process, SolverRecorder& recorder, const SolverLimits& limits) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(limits.timeout));
  const auto timed_out = [&] {
    std::string seconds;
    append_number(seconds, limits.timeout);
    recorder.abort("timeout", "No result after " + seconds + " seconds and " + std::to_string(recorder.supports()) +
                                  " support queries. The usual causes are a loop that never ends, and output that is not flushed after every line.");
  };
  using Outcome = SolverProcess::Outcome;
  std::string line;
  Outcome sent = process.write_line(recorder.scene_message(), deadline);
  while (!recorder.done()) {
    if (sent == Outcome::timeout) return timed_out();
    const Outcome got = process.read_line(line, deadline);
    if (got == Outcome::timeout) return timed_out();
    if (got == Outcome::too_long) return recorder.abort("bad-message", "The solver sent more than a megabyte without the end of a line.");
    if (got == Outcome::closed) {
      if (completed_by(recorder, line)) break;
      return ended(process, recorder, deadline, line);
    }
    if (blank(line)) continue;
    std::string reply;
    try {
      reply = recorder.take(line);
    } catch (const Error& e) {
      const std::string hint = line.find('{') != std::string::npos && line.find('}') == std::string::npos ? " A message is one line." : "";
      return recorder.abort("bad-message", "Not a message of the protocol (" + e.line() + "): " + shortened(line) + hint);
    }
    if (recorder.asks_too_much())
      return recorder.abort("support-limit", "More than " + std::to_string(limits.max_supports) + " support queries (--max-supports). The usual cause is a stopping test that never holds.");
    if (!reply.empty()) sent = process.write_line(reply, deadline);
  }
  process.close_input();
  const auto to_end = std::min(deadline, std::chrono::steady_clock::now() + std::chrono::milliseconds(500));
  nothing_follows(process, recorder, to_end);
  // It has some time to end well. One that goes on is ended.
  const auto how = process.wait(std::chrono::steady_clock::now() + std::chrono::seconds(2));
  if (!how) recorder.warn("timeout", "The solver gave its result, and then did not end, though its input was closed. It was ended.");
  if (how && !how->empty()) recorder.warn("crash", "The solver gave its result, and then ended with " + *how + "." + last_words(process));
}

}  // namespace

Method method_for_solver(const Method& of_scene) {
  Method method;
  method.penetration = of_scene.penetration, method.scalar = of_scene.scalar, method.tolerance = of_scene.tolerance, method.max_iterations = of_scene.max_iterations;
  return method;
}

Recording run_solver(const SceneFile& scene, const Settings& settings, const std::string& command, const SolverLimits& limits) {
  if (scene.scene.motion) throw Error("unsupported-query", "a solver answers scenes that do not move, not \"" + std::string(word_of(scene.scene.query)) + "\"", "/query");
  for (const Body& body : scene.scene.bodies)
    if (std::holds_alternative<Mesh>(body.shape.geometry)) throw Error("unsupported-shape", "a mesh has no support function; a solver runs on convex shapes", "/bodies");
  SolverRecorder recorder(scene, settings, limits.max_supports);
  SolverProcess process(command, limits.errors);
  const std::stop_callback ending(limits.stop, [&] { process.end(); });
  talk(process, recorder, limits);
  return std::move(recorder).finish();
}

}  // namespace gjkdbg
