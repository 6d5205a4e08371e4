// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/program_derivative.hpp"

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/model/typed/source_code.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/study/gradient/run_derivative.hpp"

namespace extremal {
namespace {

/// Texts have no part in derivatives, also where they are such as a scene file cannot have.
ResolvedScene withoutTexts(ResolvedScene scene) {
    Scene& s = scene.scene;
    for (std::string* const text : {&s.title, &s.source, &s.lesson, &s.notes}) text->clear();
    for (std::size_t i = 0; i < s.events.size(); ++i) s.events[i].label = "event " + std::to_string(i + 1);
    for (std::size_t i = 0; i < s.schemes.size(); ++i)
        s.schemes[i].label = scene.schemes[i].spec.label = "scheme " + std::to_string(i + 1);
    return scene;
}

ProgramDerivative byPointers(const ResolvedScene& given, std::size_t scheme, const typed::Formula& formula,
                             const std::vector<std::string>& pointers) {
    if (pointers.size() > mostVariedNumbers)
        throw InvalidScene("--with", "takes at most " + std::to_string(mostVariedNumbers) + " numbers, got " +
                                         std::to_string(pointers.size()));
    const ResolvedScene scene = withoutTexts(given);
    const RunDerivative run(scene, {.pointers = pointers, .scheme = scene.schemes[scheme].spec.label});
    ProgramDerivative made;
    made.parameters = run.parameterNames();
    for (const std::string& name : made.parameters)
        if (std::none_of(formula.parameters.begin(), formula.parameters.end(),
                         [&](const auto& each) { return each.first == name; }))
            throw InvalidScene("--with", "\"" + name + "\" is not a parameter of the formula in the program",
                               "parameters and initial values");
    const auto count = static_cast<Eigen::Index>(pointers.size());
    made.start.resize(2 * run.dimension(), count);
    made.byNumbers.setZero(static_cast<Eigen::Index>(made.parameters.size()), count);
    for (Eigen::Index n = 0; n < count; ++n) {
        const SensitivityColumn& number = run.numbers()[static_cast<std::size_t>(n)];
        made.names.push_back(number.name);
        made.start.col(n) = Eigen::Map<const Eigen::VectorXd>(number.start.data(), made.start.rows());
        for (Eigen::Index u = 0; u < made.byNumbers.rows(); ++u)
            made.byNumbers(u, n) = number.parameters[static_cast<std::size_t>(u)];
    }
    return made;
}

}  // namespace

ProgramDerivative programDerivative(const ResolvedScene& scene, std::size_t scheme,
                                    const typed::Formula& formula, const std::vector<std::string>& with) {
    if (!with.empty()) return byPointers(scene, scheme, formula, with);
    std::vector<std::string> pointers;
    for (const NumberOfScene& number : numbersOf(scene.scene, *scene.system))
        if (pointers.size() < mostVariedNumbers) pointers.push_back(number.pointer);
    try {
        if (!pointers.empty()) {
            ProgramDerivative made = byPointers(scene, scheme, formula, pointers);
            (void)typed::parameterLines(formula, made.parameters, typed::Language::cpp);
            return made;
        }
    } catch (const InvalidScene&) {  // one of the numbers cannot be varied; those below can
    } catch (const ExpressionError&) {
    }
    const std::vector<Quantity> columns = stateColumns(*scene.system);
    ProgramDerivative made;
    const auto rows = static_cast<Eigen::Index>(columns.size()),
               count = std::min(rows, static_cast<Eigen::Index>(mostVariedNumbers));
    for (Eigen::Index n = 0; n < count; ++n)
        made.names.push_back("start." + columns[static_cast<std::size_t>(n)].name);
    made.start.setIdentity(rows, count);
    made.byNumbers.resize(0, count);
    return made;
}

}  // namespace extremal
