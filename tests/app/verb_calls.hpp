// SPDX-License-Identifier: GPL-3.0-or-later
/// A call of every verb on the scene s.json, for options_test.cpp.
#pragma once

#include <QMap>
#include <QString>
#include <QStringList>

namespace extremal::options_test {

inline QStringList words(const char* text) { return QString(text).split(' ', Qt::SkipEmptyParts); }

/// The verb and what it cannot do without, but for --out.
inline QStringList callOf(const QString& verb) {
    static const QMap<QString, QStringList> all{
        {"", {}},
        {"run", words("run s.json")},
        {"snapshot", words("snapshot s.json")},
        {"figure", words("figure s.json")},
        {"page", words("page s.json")},
        {"passport", words("passport s.json")},
        {"program", words("program s.json")},
        {"orbit", words("orbit s.json")},
        {"fit", words("fit s.json")},
        {"motions", words("motions s.json")},
        {"gradient", words("gradient s.json")},
        {"steer", words("steer s.json")},
        {"formulas", words("formulas s.json")},
        {"check", words("check s.json")},
        {"study convergence", words("study convergence s.json --repeat 0")},
        {"study work-precision", words("study work-precision s.json --repeat 0")},
        {"study cheapest", words("study cheapest s.json --repeat 0")},
        {"study needs", words("study needs s.json --repeat 0")},
        {"study stability", words("study stability s.json")},
        {"study linear-stability", words("study linear-stability s.json")},
        {"study limits", words("study limits s.json")},
        {"study extremes", words("study extremes --shard 1/1000")},
        {"study merge", words("study merge one two")},
        {"atlas", words("atlas --quick --systems harmonic-oscillator")},
        {"wisdom", words("wisdom")},
        {"list", words("list views")},
        {"handbook", words("handbook tour")},
        {"completion", words("completion bash")},
        {"manual", words("manual")},
    };
    return all.value(verb, {"unknown verb"});
}

/// What else the verb needs where the option under test is not that.
inline QStringList needsOf(const QString& verb) {
    static const QMap<QString, QStringList> all{
        {"run", words("--out d")},
        {"snapshot", words("--view energy --out p.png")},
        {"figure", words("--view energy --view phase --out p.svg")},
        {"page", words("--out p.html --frames 2")},
        {"passport", words("--no-measure")},
        {"program", words("--out p.cpp")},
        {"orbit", words("--out d --period 2")},
        {"fit", words("--data m.csv --free /model/l --out d")},
        {"motions", words("--starts m.csv --out d")},
        {"steer", words(R"(--set /model={"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2+u*x",)"
                        R"("controls":{"u":"0"}} --over u^2/2 --end x --out d)")},
        {"gradient", words("--of theta --with /model/l --out d")},
        {"study cheapest", words("--error 1e-2 --out d")},
        {"study needs", words("--wish 1e-2 --candidates scene --out d")},
        {"study stability", words("--x /schemes/*/step=0.1:1:2 --out d")},
        {"study limits", words("--wish energy=1e-2 --search-time 100ms --out d")},
        {"atlas", words("--out d")},
        {"wisdom", words("--modes 8 --out w")},
    };
    return all.value(verb, verb.startsWith("study") ? words("--out d") : QStringList());
}

}  // namespace extremal::options_test
