// The program `stipple`: one line a command.
#include "src/cli/cli.h"
#include "src/command/bench.h"
#include "src/command/build.h"
#include "src/command/check.h"
#include "src/command/compare.h"
#include "src/command/info.h"
#include "src/command/render.h"
#include "src/command/scene.h"
#include "src/command/study.h"
#include "src/command/view.h"

int main(int argc, char** argv) {
  CLI::App app("Progressive renderer for very large point clouds.", "stipple");
  app.set_version_flag("--version", std::string(stipple::version()), "Print the version and exit.");
  app.footer("`stipple COMMAND --help` explains a command. Exit codes: 0 done, 1 the work failed, 2 wrong usage.");
  stipple::add_info_command(app);
  stipple::add_check_command(app);
  stipple::add_build_command(app);
  stipple::add_render_command(app);
  stipple::add_view_command(app);
  stipple::add_study_command(app);
  stipple::add_compare_command(app);
  stipple::add_scene_command(app);
  stipple::add_bench_command(app);
  return stipple::run_program(app, argc, argv);
}
