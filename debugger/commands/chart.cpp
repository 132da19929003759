// chart: speed against accuracy, into a folder.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <unistd.h>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/lab.h"
#include "debugger/commands/output_file.h"
#include "debugger/lab/chart.h"
#include "shapes/error.h"

namespace gjkdbg {

namespace {
std::atomic<bool> interrupted{false};
}

LabProgress::LabProgress() : began_(std::chrono::steady_clock::now()) {
  interrupted = false;
  std::signal(SIGINT, [](int) {
    interrupted = true;
    std::signal(SIGINT, SIG_DFL);
  });
}
LabProgress::~LabProgress() { std::signal(SIGINT, SIG_DFL); }

bool LabProgress::operator()(double share) {
  if (isatty(STDERR_FILENO) != 0) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    const int left = share > 0 ? static_cast<int>(seconds / share * (1 - share) + 0.5) : 0;
    std::cerr << "\r" << static_cast<int>(share * 100) << "%, " << left << " s left\033[K" << (share >= 1 ? "\n" : "") << std::flush;
  }
  return !interrupted;
}

bool LabProgress::tell_if_interrupted(const std::string& folder) const {
  if (interrupted) std::cerr << (isatty(STDERR_FILENO) != 0 ? "\n" : "") << "gjkdbg: interrupted: " << folder << " holds what was done until then\n";
  return interrupted;
}

namespace {

/// Whole or not at all; an older picture is none of these numbers.
bool draw(const std::function<std::string(const std::string&, const std::string&)>& commands, const std::string& terminal, const std::string& target) {
  const std::string part = target + ".part";
  std::error_code error;
  const bool drawn = run_gnuplot(commands(terminal, part));
  if (drawn) std::filesystem::rename(part, target, error);
  if (drawn && !error) return true;
  std::filesystem::remove(part, error), std::filesystem::remove(target, error);
  return false;
}

}  // namespace

void draw_both(const std::function<std::string(const std::string&, const std::string&)>& commands, const std::filesystem::path& stem, int width, int height) {
  const std::string size = " size " + std::to_string(width) + "," + std::to_string(height);
  const bool svg = draw(commands, "svg" + size + " font 'Inter,12' background '#ffffff'", stem.string() + ".svg"), png = draw(commands, "pngcairo" + size + " font 'Inter,11'", stem.string() + ".png");
  if (!svg || !png) std::cerr << "gjkdbg: " << stem.filename().string() << ": gnuplot is not installed or failed: not drawn, only the numbers\n";
}

namespace {

struct ChartCommand {
  ChartOptions options;
  std::string output = "chart";

  int run() const {
    (void)chosen(variants(), options.methods), (void)chart_families(0, options.families);  // a name there is not: before anything is made
    LabProgress progress;
    make_folder(output);
    const Chart chart = make_chart(options, std::ref(progress));
    const std::filesystem::path folder(output);
    write_output((folder / "chart.csv").string(), chart_csv(chart));
    write_output((folder / "chart.json").string(), chart_json(chart));
    for (const ChartPicture& picture : chart_pictures())
      if (picture.has_something(chart)) draw_both([&](const std::string& terminal, const std::string& file) { return picture.drawing(chart, terminal, file); }, folder / picture.name, picture.width, picture.height);
    print(chart);
    const bool nothing = std::all_of(chart.panels.begin(), chart.panels.end(), [](const ChartPanel& panel) { return panel.points.empty(); });
    if (!progress.tell_if_interrupted(output) && nothing) std::cerr << "gjkdbg: nothing to chart: none of these methods answers in these families\n";
    return exit_done;
  }

  static std::string published(const std::array<double, 2>& iterations) {
    return "  (" + std::to_string(static_cast<int>(iterations[0])) + " +- " + std::to_string(static_cast<int>(iterations[1])) + ")";
  }

  static void print(const Chart& chart) {
    for (const ChartPanel& panel : chart.panels) {
      std::cout << panel.title << " (" << panel.pairs << " pairs)\n";
      for (const ChartPoint& p : panel.points)
        if (p.front)
          std::cout << "  " << std::left << std::setw(26) << p.variant << " tolerance " << std::setw(7) << p.tolerance << std::right << std::setw(8) << std::fixed << std::setprecision(0) << p.nanoseconds
                    << std::defaultfloat << std::setprecision(2) << " ns, worst error " << p.worst_error << (p.wrong > 0 ? ", " + std::to_string(p.wrong) + " off by more than 1e-3" : "") << "\n";
    }
    if (!chart.price.empty()) std::cout << "What modelling too much costs\n";
    for (const PricePoint& p : chart.price)
      std::cout << "  " << std::left << std::setw(42) << p.what << std::right << std::setw(8) << std::fixed << std::setprecision(0) << p.nanoseconds << std::defaultfloat << std::setprecision(3) << " ns, "
                << p.supports << " supports, worst error " << std::setprecision(2) << p.worst_error << "\n";
    if (!chart.ladder.empty()) std::cout << "Iterations by distance, time (in brackets: Montaut et al. 2024, table III a, and 2022, table I)\n";
    for (const LadderPoint& p : chart.ladder)
      std::cout << "  " << std::left << std::setw(16) << p.shapes << std::setw(10) << p.method << std::right << std::setw(8) << std::defaultfloat << p.distance << std::fixed << std::setprecision(1) << std::setw(8)
                << p.mean << " +- " << p.deviation << (p.published ? published(*p.published) : "") << std::setprecision(0) << std::setw(10) << p.nanoseconds << " ns"
                << (p.published_nanoseconds ? "  (" + std::to_string(static_cast<int>(*p.published_nanoseconds)) + ")" : "") << "\n";
    if (!chart.motion.empty()) std::cout << "Motion: casts by tolerance (error: how early), integrators by step (error: energy)\n";
    for (const MotionPoint& p : chart.motion)
      std::cout << "  " << std::left << std::setw(16) << p.family << std::setw(26) << p.method << std::setw(8) << std::defaultfloat << p.parameter << std::right << std::setw(9) << std::fixed << std::setprecision(0)
                << p.nanoseconds << std::defaultfloat << std::setprecision(2) << " ns, worst error " << p.worst_error << (p.late > 0 ? ", " + std::to_string(p.late) + " late" : "") << "\n";
  }
};

}  // namespace

void add_chart(CLI::App& app, Status& status) {
  auto options = std::make_shared<ChartCommand>();
  CLI::App* command = app.add_subcommand("chart", "Speed against accuracy: SVG, PNG, CSV, JSON into a folder");
  command->add_flag("--quick", options->options.quick, "fewer pairs and tolerances");
  command->add_option("--families", options->options.families, "only these, separated by commas; an unknown name lists all")->delimiter(',');
  command->add_option("--methods,--method", options->options.methods, "only methods whose names begin so: default, johnson, sat, …; an unknown name lists all");
  command->add_option("-o,--output", options->output, "folder (chart)")->check(named());
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
