// The program's commands: each adds itself to the command line; what it does is in the file of its name.
#pragma once

namespace CLI {
class App;
}

namespace gjkdbg {

/// Exit statuses of the program.
enum ExitStatus { exit_done = 0, exit_difference = 1, exit_bad_input = 2 };

/// Every command stores its exit status here when it has run.
using Status = int;

void add_dump(CLI::App& app, Status& status);
void add_verify(CLI::App& app, Status& status);
void add_diff(CLI::App& app, Status& status);
void add_query(CLI::App& app, Status& status);
void add_check(CLI::App& app, Status& status);
void add_run(CLI::App& app, Status& status);
void add_sweep(CLI::App& app, Status& status);
void add_chart(CLI::App& app, Status& status);
void add_atlas(CLI::App& app, Status& status);
void add_scenes(CLI::App& app, Status& status);
void add_view(CLI::App& app, Status& status);    ///< only in builds with the window
void add_render(CLI::App& app, Status& status);  ///< the same

}  // namespace gjkdbg
