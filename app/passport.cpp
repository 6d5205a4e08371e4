#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/program.hpp"
#include "engine/run/export.hpp"
#include "engine/scene/json.hpp"

namespace extremal::app {
namespace {

PageFormat formatOf(const PassportRequest& request) {
    if (request.format == "html") return PageFormat::html;
    if (request.format == "tex") return PageFormat::latex;
    if (request.format == "md") return PageFormat::markdown;
    if (request.out.ends_with(".html")) return PageFormat::html;
    return request.out.ends_with(".tex") ? PageFormat::latex : PageFormat::markdown;
}

}  // namespace

int passportVerb(const std::string& scene, const PassportRequest& request, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    try {
        const std::size_t place = schemeNamed(*read.resolved, request.scheme);
        const Document page = passportOf(*read.resolved, place, {request.isMeasured, options.threads});
        const std::string text = written(page, formatOf(request));
        if (!request.out.empty()) writeFile(request.out, text);
        if (options.isJson) {
            Value document{Value::Object{}};
            document.set("scheme", page.title);
            document.set(request.out.empty() ? "page" : "file", request.out.empty() ? text : request.out);
            return print(writeJson(document), done);
        }
        if (request.out.empty()) return print(text, done);
        return options.isQuiet ? done : print(page.title + ": " + request.out + "\n", done);
    } catch (const InvalidScene& e) {
        printProblems(sceneName(scene), e.problems());
        return unusable;
    } catch (const ExportError& e) {
        printProblem(e.path.string(), e.what());
        return unwritable;
    }
}

int programVerb(const std::string& scene, const ProgramRequest& request, const CommonOptions& options) {
    const bool isPython =
        request.language.empty() ? request.out.ends_with(".py") : request.language == "python";
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    const std::string* label = &request.scheme;
    try {
        const std::size_t place = schemeNamed(*read.resolved, request.scheme);
        label = &read.resolved->schemes[place].spec.label;
        writeFile(request.out, programOf(*read.resolved, place,
                                         isPython ? ProgramLanguage::python : ProgramLanguage::cpp));
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems())
            printProblem(p.pointer.empty() ? sceneName(scene) + ": " + *label : p.pointer, p.message, p.hint);
        return unusable;
    } catch (const ExportError& e) {
        printProblem(e.path.string(), e.what());
        return unwritable;
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
