// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>
#include <vector>

#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/program.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/single_scheme.hpp"

namespace extremal::app {
namespace {

/// What the ending of a file stands for; an ending that none of them has is an error.
template <class Kind>
Kind byEnding(const std::string& file, const std::vector<std::pair<std::string, Kind>>& endings,
              const std::string& option) {
    std::vector<std::string> names;
    for (const auto& [ending, kind] : endings) {
        if (file.ends_with(ending)) return kind;
        names.push_back(ending);
    }
    throw InvalidScene("--out", "the ending of \"" + file + "\" is not that of a format",
                       "one of " + joinNames(names) + ", or " + option);
}

PageFormat formatOf(const PassportRequest& request) {
    if (request.format == "html") return PageFormat::html;
    if (request.format == "tex") return PageFormat::latex;
    if (request.format == "md" || request.out.empty()) return PageFormat::markdown;
    return byEnding<PageFormat>(request.out,
                                {{".md", PageFormat::markdown},
                                 {".html", PageFormat::html},
                                 {".htm", PageFormat::html},
                                 {".tex", PageFormat::latex}},
                                "--format");
}

ProgramLanguage languageOf(const ProgramRequest& request) {
    if (request.language == "python") return ProgramLanguage::python;
    if (request.language == "cpp") return ProgramLanguage::cpp;
    return byEnding<ProgramLanguage>(request.out,
                                     {{".cpp", ProgramLanguage::cpp},
                                      {".cc", ProgramLanguage::cpp},
                                      {".cxx", ProgramLanguage::cpp},
                                      {".py", ProgramLanguage::python}},
                                     "--language");
}

}  // namespace

int passportVerb(const std::string& scene, const PassportRequest& request, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    try {
        const PageFormat format = formatOf(request);
        const Replacing replacing = replacingOf(scene, read, options);
        if (!request.out.empty()) requireReplaceable(request.out, replacing);  // before the measurements
        const std::size_t place = schemeNamed(*read.resolved, request.scheme);
        const Document page = passportOf(*read.resolved, place, {request.isMeasured, options.threads});
        const std::string text = request.out.empty() ? written(page, format) : writtenForFile(page, format);
        if (!request.out.empty()) writeFile(request.out, text, replacing);
        if (options.isJson) {
            Value document{Value::Object{}};
            document.set("scheme", page.title);
            document.set(request.out.empty() ? "page" : "file", request.out.empty() ? text : request.out);
            return print(writeJson(document), done);
        }
        if (request.out.empty()) return print(text, done);
        return options.isQuiet ? done : print(page.title + ": " + request.out + "\n", done);
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
}

int programVerb(const std::string& scene, const ProgramRequest& request, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    const std::string* label = &request.scheme;
    try {
        const ProgramLanguage language = languageOf(request);
        const std::size_t place = schemeNamed(*read.resolved, request.scheme);
        label = &read.resolved->schemes[place].spec.label;
        writeFile(request.out, programOf(*read.resolved, place, language, request.with),
                  replacingOf(scene, read, options));
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems())
            printProblem(p.pointer.empty() ? sceneName(scene) + ": " + *label : p.pointer, p.message, p.hint);
        return unusable;
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
    if (options.isJson) {
        Value document{Value::Object{}};
        document.set("scheme", *label);
        document.set("file", request.out);
        return print(writeJson(document), done);
    }
    return options.isQuiet ? done : print(*label + ": " + request.out + "\n", done);
}

}  // namespace extremal::app
