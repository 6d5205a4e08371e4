// SPDX-License-Identifier: GPL-3.0-or-later
/// Which verb takes which option, and for `study` which study: the parser declares and refuses by this table,
/// and a test walks it. An option that a verb would not obey is not in its row.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace extremal::app {

struct VerbOptions {
    std::string_view verb;  ///< empty: the window; "study KIND" for each study, and "study merge"
    std::vector<std::string_view> options;
};

/// Without --help, which every verb has.
inline const std::vector<VerbOptions>& optionTable() {
    using Options = std::vector<std::string_view>;
    const auto joined = [](std::initializer_list<Options> parts) {
        Options all;
        for (const Options& part : parts) all.insert(all.end(), part.begin(), part.end());
        return all;
    };
    static const Options scene{"--set", "--add", "--trust"}, words{"--json", "--quiet"}, limits{"--threads"},
        files{"--out", "--force"}, study{"--only", "--shard", "--resume", "--plot"},
        sweep{"--metric", "--final", "--repeat"}, ladder{"--steps", "--from", "--to", "--points"};
    static const std::vector<VerbOptions> table{
        {"", {"--version", "--verbose"}},
        {"run", joined({scene, words, limits, files, {"--resume", "--checkpoint"}})},
        {"snapshot",
         joined({scene, words, limits, files, {"--size", "--view", "--time", "--compare", "--tolerance"}})},
        {"figure", joined({scene,
                           words,
                           limits,
                           files,
                           {"--view", "--only", "--width", "--ratio", "--letters", "--lines", "--columns",
                            "--dpi", "--font", "--legend", "--colours", "--portraits", "--titles", "--equal",
                            "--times", "--caption", "--draw-caption"}})},
        {"page", joined({scene, words, limits, files, {"--frames"}})},
        {"passport", joined({scene, words, limits, files, {"--scheme", "--format", "--measure"}})},
        {"program", joined({scene, words, limits, files, {"--scheme", "--language", "--with"}})},
        {"orbit", joined({scene,
                          words,
                          files,
                          {"--scheme", "--period", "--energy", "--hold", "--follow", "--points", "--guess",
                           "--manifold", "--starts"}})},
        {"fit", joined({scene, words, files, {"--data", "--free", "--columns", "--scheme", "--bias"}})},
        {"motions", joined({scene, words, limits, files, {"--starts", "--scheme"}})},
        {"gradient", joined({scene, words, files, {"--of", "--over", "--with", "--scheme"}})},
        {"steer",
         joined({scene, words, files, {"--control", "--of", "--over", "--end", "--bounds", "--scheme"}})},
        {"formulas", joined({scene, {"--quiet", "--equations"}, files})},
        {"check", joined({scene, words, limits})},
        {"study convergence", joined({scene, words, limits, files, study, sweep, ladder, {"--knobs"}})},
        {"study work-precision", joined({scene, words, limits, files, study, sweep, ladder, {"--knobs"}})},
        {"study cheapest", joined({scene,
                                   words,
                                   limits,
                                   files,
                                   study,
                                   sweep,
                                   {"--error", "--wish", "--budget", "--memory", "--candidates", "--over",
                                    "--of", "--knobs", "--search-time"}})},
        {"study needs", joined({scene,
                                words,
                                limits,
                                files,
                                study,
                                sweep,
                                {"--error", "--wish", "--memory", "--candidates", "--over", "--of", "--knobs",
                                 "--search-time"}})},
        {"study stability", joined({scene, words, limits, files, study, {"--x", "--y", "--limit"}})},
        {"study linear-stability", joined({scene, words, limits, files, study})},
        {"study limits", joined({scene,
                                 words,
                                 limits,
                                 files,
                                 study,
                                 {"--metric", "--final", "--error", "--wish", "--search-time"}})},
        // Those of a scene with --x alone.
        {"study extremes", joined({scene,
                                   words,
                                   limits,
                                   files,
                                   {"--shard", "--resume", "--long", "--only", "--x", "--y", "--metric",
                                    "--final", "--error", "--wish"}})},
        {"study merge", joined({words, files, {"--plot"}})},
        {"atlas", joined({words, limits, files, {"--systems", "--quick", "--resume"}})},
        {"wisdom", joined({words, limits, {"--out", "--modes"}})},
        {"list", {"--json"}},
        {"handbook", {"--json"}},
        {"completion", {}},
        {"manual", {}},
    };
    return table;
}

inline bool has(const VerbOptions& row, std::string_view option) {
    return std::find(row.options.begin(), row.options.end(), option) != row.options.end();
}

/// Whether the verb, of `study` any of its kinds, has the option.
inline bool takes(std::string_view verb, std::string_view option) {
    return std::any_of(optionTable().begin(), optionTable().end(), [&](const VerbOptions& row) {
        return row.verb.substr(0, row.verb.find(' ')) == verb && has(row, option);
    });
}

/// The verbs that have the option, or, for a question about a study, the studies.
inline std::vector<std::string> takersOf(std::string_view option, bool areStudiesTold) {
    std::vector<std::string> names;
    for (const VerbOptions& row : optionTable()) {
        if (!has(row, option)) continue;
        const std::string_view verb = areStudiesTold ? row.verb : row.verb.substr(0, row.verb.find(' '));
        const std::string name(verb.empty() ? "extremal alone" : verb);
        if (names.empty() || names.back() != name) names.push_back(name);
    }
    return names;
}

}  // namespace extremal::app
