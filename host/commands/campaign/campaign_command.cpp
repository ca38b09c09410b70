#include "commands/campaign/campaign_command.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "base/platform.h"
#include "cli/command_line.h"

namespace jawari::host {

namespace {

/// Runs the package's own command line; says in one line if there is no package.
constexpr const char* script =
    "import sys\n"
    "try:\n"
    "    from jawari.campaign.__main__ import main\n"
    "except ImportError as problem:\n"
    "    print('jawari campaign: the Python package jawari is not there: ' + str(problem) + '; see "
    "docs/python.md', "
    "file=sys.stderr)\n"
    "    sys.exit(4)\n"
    "sys.exit(main(program='jawari campaign'))\n";

/// JAWARI_PYTHON, or the Python that the package was built for.
std::string interpreter() {
    const char* chosen = std::getenv("JAWARI_PYTHON");
    return chosen != nullptr && *chosen != '\0' ? chosen : JAWARI_PYTHON_INTERPRETER;
}

/// The package of a build tree lies beside the folder of the program; an installed one Python finds by
/// itself.
void name_own_package() {
    const std::filesystem::path program(platform::own_path());
    const std::filesystem::path packages = program.parent_path().parent_path() / "python";
    if (program.empty() || !path_exists((packages / "jawari" / "__init__.py").string())) return;
    const char* others = std::getenv("PYTHONPATH");
    const bool some = others != nullptr && *others != '\0';
    platform::set_environment("PYTHONPATH", packages.string() + (some ? std::string(":") + others : ""));
}

MaybeError hand_over(const std::vector<std::string>& words) {
    name_own_package();
    std::vector<std::string> arguments{interpreter(), "-c", script};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const std::string reason = platform::become_program(arguments);
    return Error{ErrorKind::File, "jawari campaign: " + arguments.front() + ": " + reason +
                                      " (allowed: a Python 3, which JAWARI_PYTHON names)"};
}

}  // namespace

void add_campaign_command(CLI::App& app, Command& command) {
    CLI::App* campaign_app =
        app.add_subcommand("campaign", "Runs one scene at many settings: on all processors, Slurm or Dask");
    campaign_app->prefix_command();
    campaign_app->set_help_flag();  // the package has its own
    campaign_app->callback([campaign_app, &command] {
        const std::vector<std::string> words = campaign_app->remaining();
        command = [words] { return hand_over(words); };
    });
}

}  // namespace jawari::host
