// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/model/typed/source_code.hpp"
#include "engine/passport/program_derivative.hpp"
#include "engine/passport/program_text.hpp"
#include "engine/passport/scene_formula.hpp"
#include "engine/passport/scheme_tableau.hpp"
#include "engine/run/files/replacing.hpp"
#include "engine/space/typed.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {
namespace {

using typed::Language;

std::string number(double x) {
    std::string text = formatNumber(x);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

/// Tables and constants in the words of a language.
class Writer {
public:
    explicit Writer(Language language) : isPython_(language == Language::python) {}

    void comment(const std::string& line) { text += (isPython_ ? "# " : "// ") + commentText(line) + "\n"; }
    void scalar(const std::string& name, double x) {
        text += isPython_ ? name + " = " + number(x) + "\n"
                          : "constexpr double " + name + " = " + number(x) + ";\n";
    }
    void integer(const std::string& name, long long x) {
        text += isPython_ ? name + " = " + std::to_string(x) + "\n"
                          : "constexpr long " + name + " = " + std::to_string(x) + ";\n";
    }
    void vector(const std::string& name, const auto& v) {
        text += isPython_ ? name + " = np.array(" : "constexpr double " + name + "[] = ";
        text += row(v) + (isPython_ ? ")\n" : ";\n");
    }
    void matrix(const std::string& name, const auto& M) {
        text += isPython_ ? name + " = np.array(["
                          : "constexpr double " + name + "[][" + std::to_string(M.cols()) + "] = {";
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            text += (i > 0 ? ",\n    " : "\n    ") + row(Eigen::VectorXd(M.row(i).transpose()));
        text += isPython_ ? "])\n" : "};\n";
    }
    std::string text;

private:
    std::string row(const auto& v) const {
        std::string list = isPython_ ? "[" : "{";
        for (Eigen::Index i = 0; i < v.size(); ++i)
            list += (i > 0 ? ", " : "") + number(static_cast<double>(v(i)));
        return list + (isPython_ ? "]" : "}");
    }
    bool isPython_;
};

Eigen::VectorXd vectorOf(const double* x, int n) { return Eigen::Map<const Eigen::VectorXd>(x, n); }

[[noreturn]] void refuse(const std::string& reason, const std::string& hint = {}) {
    throw InvalidScene("", "cannot be exported as a program: " + reason, hint);
}

enum class Kind { galerkin, stages, rungeKutta };

/// How the step is taken. An explicit tableau of separable systems is taken stage by stage.
struct Method {
    Kind kind = Kind::galerkin;
    std::shared_ptr<const Tableau> tableau;
    std::optional<Table<double>> table;
};

Method methodOf(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    Method method;
    std::string reason;
    method.tableau = tableauOf(scene, scheme, reason);
    const Mechanical& mechanics = scene.system->mechanics();
    const bool isExplicit = method.tableau && method.tableau->isExplicit() && mechanics.isSeparable &&
                            method.tableau->scope != TableauScope::any;
    if (isExplicit) {
        method.kind = Kind::stages;
        return method;
    }
    if (scheme.family) {
        const Discretization& d = scheme.discretization;
        const auto* const tables = scheme.family->parts.find<Tables>();
        if (tables && (hasTable(d) || dependsOnStep(d.space))) {
            method.table = tables->make(withStep(d.space, scheme.spec.step.value), d.quadrature);
            return method;
        }
        if (tables) refuse(reason);
    }
    if (!method.tableau) refuse(reason);
    if (method.tableau->scope != TableauScope::any)
        refuse("kicks and drifts are not explicit for " + scene.system->id,
               "a Galerkin or Runge-Kutta scheme");
    method.kind = Kind::rungeKutta;
    return method;
}

void writeGalerkin(const Table<double>& t, Writer& w, bool isPython) {
    if (!isPython) {
        w.text += "constexpr int n = " + std::to_string(t.nodes()) + ", m = " + std::to_string(t.unknowns()) +
                  ";  // nodes, unknowns\n";
    }
    w.comment(
        "Nodes and weights; functions and their slopes at the nodes, one row per node; test functions.");
    w.vector("c", t.node);
    w.vector("b", t.weight);
    w.matrix("phi", t.value);
    w.matrix("dphi", t.derivative);
    w.matrix("psi", t.testValue);
    w.matrix("dpsi", t.testDerivative);
}

void writeTableau(const Tableau& t, Writer& w, bool isPython, bool isByStages) {
    if (!isPython)
        w.text += "constexpr int nV = " + std::to_string(t.velocities()) +
                  ", nF = " + std::to_string(t.forces()) + ";  // stages\n";
    w.comment("Q_i = q_0 + h sum_j A_ij V_j, P_j = p_0 + h sum_i A_hat_ji F_i.");
    w.matrix("A", t.A.cast<double>().eval());
    w.matrix("A_hat", t.Ahat.cast<double>().eval());
    w.vector("b", t.b.cast<double>().eval());
    w.vector("b_hat", t.bHat.cast<double>().eval());
    w.vector("c", t.c.cast<double>().eval());
    if (isByStages) {
        w.vector("c_hat", t.cHat.cast<double>().eval());
        std::string order;
        for (const auto& [isOfV, i] : stageOrder(t))
            order += (order.empty() ? "" : ", ") + std::string(isPython ? "(" : "{") + (isOfV ? "1" : "0") +
                     ", " + std::to_string(i) + (isPython ? ")" : "}");
        w.text += isPython ? "order = [" + order + "]\n" : "constexpr int order[][2] = {" + order + "};\n";
    } else {
        w.text += isPython ? std::string("is_explicit = ") + (t.isExplicit() ? "True" : "False") + "\n"
                           : std::string("constexpr bool is_explicit = ") +
                                 (t.isExplicit() ? "true" : "false") + ";\n";
    }
}

std::string indented(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += "    " + line + "\n";
    return text;
}

/// What the program is, how it is called, and what it includes.
void writeHead(const std::string& label, const std::string& title, const std::string& lagrangian, Writer& w,
               bool isPython) {
    // Without a declaration of its own Python would take one from what follows: "Decoding: the pendulum".
    if (isPython) w.text = "#!/usr/bin/env python3\n# -*- coding: utf-8 -*-\n";
    w.comment(label + " on " + title);
    w.comment("");
    w.comment("L = " + lagrangian);
    w.comment("");
    if (isPython) {
        w.comment("python3 FILE.py          prints the run of the scene as CSV");
        w.comment("python3 FILE.py RUN.csv  compares with the CSV of a run, to 1e-13");
        w.comment("python3 FILE.py --derivative  prints the derivative of the state at the end by numbers");
    } else {
        w.comment("g++ -O2 -std=c++17 FILE.cpp && ./a.out         prints the run of the scene as CSV");
        w.comment("./a.out RUN.csv                                 compares with the CSV of a run, to 1e-13");
        w.comment(
            "./a.out --derivative              prints the derivative of the state at the end by numbers");
    }
    w.text += isPython ? program_text::pythonHead : program_text::cppHead;
}

/// Parameters, the start, the step, and the columns of the CSV.
void writeScene(const ResolvedScene& scene, const ResolvedScheme& scheme, const typed::Formula& formula,
                const std::vector<double>& parts, Writer& w, bool isPython) {
    const int d = scene.system->dimension();
    w.text += isPython ? "d = " + std::to_string(d) + "\n" : "constexpr int d = " + std::to_string(d) + ";\n";
    for (const auto& [name, value] : formula.parameters) w.scalar("k_" + name, value);
    const State start = initialOf(scene, scheme);
    const double h = scheme.spec.step.value;
    w.scalar("t_start", start.t);
    w.scalar("h_step", h);
    w.integer("steps_of_the_scene", std::llround((scene.scene.end.value - start.t) / h));
    w.vector("q_start", vectorOf(start.x.data(), d));
    w.vector("p_start", vectorOf(start.x.data() + d, d));
    w.vector("parts", vectorOf(parts.data(), static_cast<int>(parts.size())));
    std::string columns = "t";
    for (const Quantity& q : stateColumns(*scene.system)) columns += "," + q.name;
    w.text += isPython ? "columns = " + pythonString(columns) + ".split(',')\n"
                       : "const char* const columns = " + cppString(columns) + ";\n";
    w.text += "\n";
}

/// The numbers that the program differentiates by: how the start and the parameters change with them.
void writeDerivative(const ProgramDerivative& by, Writer& w, bool isPython) {
    const auto count = std::to_string(by.names.size()), parameters = std::to_string(by.parameters.size());
    std::string names;
    for (const std::string& name : by.names) names += (names.empty() ? "" : ",") + name;
    w.comment("Derivatives are by these numbers; how the start and the parameters change with them.");
    w.text += isPython ? "numbers = " + pythonString(names) + ".split(',')\nu = " + parameters + "\n"
                       : "const char* const numbers = " + cppString(names) + ";\nconstexpr int N = " + count +
                             ", u = " + parameters + ";\n";
    w.matrix("d_start", by.start);
    if (by.byNumbers.rows() > 0)
        w.matrix("d_parameters", by.byNumbers);
    else
        w.text += isPython ? "d_parameters = np.zeros((0, " + count + "))\n"
                           : "constexpr double d_parameters[1][N] = {};  // none\n";
    w.text += "\n";
}

/// The derivatives of the Lagrangian, the step, and what runs and compares it.
void writeFunctions(const typed::Formula& formula, const ProgramDerivative& by, Kind kind, Writer& w,
                    bool isPython) {
    using namespace program_text;
    const Language language = isPython ? Language::python : Language::cpp;
    const auto lines = indented(typed::derivativeLines(formula, language));
    const auto byParameters = by.parameters.empty()
                                  ? std::string()
                                  : indented(typed::parameterLines(formula, by.parameters, language));
    const auto step = [&](const char* galerkin, const char* stages, const char* rungeKutta) {
        return kind == Kind::galerkin ? galerkin : kind == Kind::stages ? stages : rungeKutta;
    };
    if (isPython)
        w.text.append(pythonDerivatives)
            .append(lines)
            .append(pythonByParameters)
            .append(byParameters)
            .append(pythonCommon)
            .append(step(pythonGalerkin, pythonStages, pythonRungeKutta))
            .append(pythonMain);
    else
        w.text.append(cppDerivatives)
            .append(lines)
            .append(cppByParameters)
            .append(byParameters)
            .append(cppCommon)
            .append(step(cppGalerkin, cppStages, cppRungeKutta))
            .append(cppMain);
}

}  // namespace

std::string programOf(const ResolvedScene& scene, std::size_t place, ProgramLanguage language,
                      const std::vector<std::string>& with) {
    const ResolvedScheme& scheme = scene.schemes[place];
    const bool isPython = language == ProgramLanguage::python;
    const System& system = *scene.system;
    const auto formula = system.isMovedOnlyBy<Mechanical>() ? formulaOf(scene) : std::nullopt;
    if (!formula)
        refuse(system.id + " does not say its Lagrangian as a formula",
               "a model of type \"lagrangian\", or one of those that do: " + joinNames(modelsWithFormula()));
    if (!scheme.isFixed()) refuse("its steps are not all of one length");
    if (scheme.isTested()) refuse("its steps keep invariants, which no table of an action does");
    const Method method = methodOf(scene, scheme);
    const ProgramDerivative by = programDerivative(scene, place, *formula, with);

    Writer w(isPython ? Language::python : Language::cpp);
    writeHead(scheme.spec.label, scene.scene.title.empty() ? system.id : scene.scene.title, formula->text, w,
              isPython);
    const bool isComposedByParts = scheme.isComposed() && method.kind == Kind::galerkin;
    writeScene(scene, scheme, *formula, isComposedByParts ? scheme.parts : std::vector<double>{1}, w,
               isPython);
    writeDerivative(by, w, isPython);
    if (method.kind == Kind::galerkin)
        writeGalerkin(*method.table, w, isPython);
    else
        writeTableau(*method.tableau, w, isPython, method.kind == Kind::stages);
    writeFunctions(*formula, by, method.kind, w, isPython);
    // In Python behind the two lines that come first: the interpreter and the encoding.
    return isPython ? markedAsOwn(w.text, "# ", {}, 2) : markedAsOwn(w.text, "// ");
}

}  // namespace extremal
