// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/load.hpp"

#include <cstdlib>
#include <filesystem>

#include "app/report.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/load_scene.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/workspace/own_schemes.hpp"

namespace extremal::app {
namespace {

/// --add: a file of schemes, all of which are meant, or one of the user's catalogue by its name; as
/// "/schemes/-={...}". Throws InvalidScene.
std::vector<std::string> overridesFor(const std::string& added) {
    std::error_code ignored;
    const bool isFile = added.ends_with(".json") || std::filesystem::is_regular_file(added, ignored);
    if (isFile && !std::filesystem::exists(added, ignored))
        throw InvalidScene("", "there is no file " + added,
                           "the path of an exported file, or a name of your catalogue");
    const std::string file = isFile ? added : ownSchemesFile();
    const OwnSchemes all = OwnSchemes::load(file);
    std::vector<std::string> names = all.names();
    if (isFile && !all.faults().empty()) throw InvalidScene(all.faults());
    if (!isFile && !all.find(added))
        throw InvalidScene("", "there is no scheme \"" + added + "\" in " + file,
                           names.empty() ? "a file of schemes" : suggestName(added, names));
    if (!isFile) names = {added};
    std::vector<std::string> overrides;
    for (const std::string& name : names)
        overrides.push_back("/schemes/-=" + writeCompactJson(*all.find(name)));
    return overrides;
}

/// --add and --set as overrides, from left to right; what is wrong with --add goes to the errors.
std::vector<std::string> overridesOf(const CommonOptions& options, std::vector<Problem>& errors) {
    std::vector<std::string> all;
    for (const std::string& added : options.added) {
        try {
            const std::vector<std::string> own = overridesFor(added);
            all.insert(all.end(), own.begin(), own.end());
        } catch (const InvalidScene& e) {
            for (Problem p : e.problems()) {
                p.message = "--add " + added + ": " + (p.pointer.empty() ? "" : p.pointer + ": ") + p.message;
                p.pointer.clear();
                errors.push_back(std::move(p));
            }
        }
    }
    all.insert(all.end(), options.overrides.begin(), options.overrides.end());
    return all;
}

}  // namespace

Replacing replacingOf(const std::string& scene, const ReadScene& read, const CommonOptions& options,
                      const std::vector<std::string>& further) {
    Replacing replacing{options.isForced, {}};
    const auto add = [&](const std::string& file) {
        if (!file.empty()) replacing.read.emplace_back(file);
    };
    if (scene == "-")
        add("/dev/stdin");  // "extremal run - < scene.json"
    else if (!scene.starts_with("preset:"))
        add(scene);
    add(read.scene.reference.path);
    for (const std::string& each : options.added) add(each);
    if (!options.added.empty()) add(ownSchemesFile());
    if (const char* wisdom = std::getenv("EXTREMAL_WISDOM")) add(wisdom);
    for (const std::string& each : further) add(each);
    return replacing;
}

std::string sceneName(const std::string& scene) { return scene == "-" ? "standard input" : scene; }

ReadScene loadScene(const std::string& scene, const CommonOptions& options) {
    std::vector<Problem> wrong;
    const std::vector<std::string> overrides = overridesOf(options, wrong);
    ReadScene read = extremal::loadScene(scene, overrides, options.isTrusted);
    read.errors.insert(read.errors.begin(), wrong.begin(), wrong.end());
    return read;
}

bool reportScene(const std::string& scene, const ReadScene& read, const CommonOptions& options) {
    printProblems(sceneName(scene), read.errors);
    if (!options.isQuiet) printProblems(sceneName(scene), read.warnings, "warning: ");
    return read.errors.empty();
}

}  // namespace extremal::app
