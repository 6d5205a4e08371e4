// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/about.hpp"

#include <QCoreApplication>
#include <QStringList>

#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/libraries.hpp"

namespace extremal {

const std::vector<std::pair<QString, QString>>& licences() {
    static const std::vector<std::pair<QString, QString>> all{
        {"Qt 6", "LGPL-3.0-only"},
        {"QCustomPlot", "GPL-3.0-or-later"},
        {"Eigen", "MPL-2.0"},
        {"Boost", "BSL-1.0"},
        {"FFTW", "GPL-2.0-or-later"},
        {"GiNaC", "GPL-2.0-or-later"},
        {"CLN", "GPL-2.0-or-later"},
        {"GMP", "LGPL-3.0-or-later OR GPL-2.0-or-later"},
        {"nlohmann-json", "MIT"},
        {"CLI11", "BSD-3-Clause"},
        {"GSL", "GPL-3.0-or-later"},
        {"SUNDIALS", "BSD-3-Clause"},
        {"Xbyak", "BSD-3-Clause"},
        {"libquadmath", "LGPL-2.1-or-later"},
        {"Mesa (OSMesa, EGL)", "MIT"},
        {"pybind11", "BSD-3-Clause"},
        {"numpy", "BSD-3-Clause"},
        {"Inter", "OFL-1.1"}};
    return all;
}

QString aboutText(const QString& drawingBackend) {
    const auto tr = [](const char* text) { return QCoreApplication::translate("extremal", text); };
    QString rows;
    const auto add = [&](const QString& what, const QString& value) {
        rows += QStringLiteral("<tr><td style='padding-right:14px'>%1</td><td>%2</td></tr>")
                    .arg(what.toHtmlEscaped(), value.toHtmlEscaped());
    };
    if (const QString version = QCoreApplication::applicationVersion(); !version.isEmpty())
        add(tr("version"), version);
    add(tr("stage drawn by"), drawingBackend);
    add(tr("instruction set"), QString::fromStdString(std::string(name(instructionSet()))));
    add(QStringLiteral("Qt"), QString::fromLatin1(qVersion()));
    for (const auto& [library, version] : libraries())
        add(QString::fromStdString(library), QString::fromStdString(version));
    QStringList ofLibraries;
    for (const auto& [library, licence] : licences()) ofLibraries << library + ' ' + licence;
    return tr("<b>Extremal</b><br>Generalized Galerkin variational integrators: pick a function space and a "
              "quadrature rule; the stationarity of the discrete action is the integrator.<br><br>"
              "GPL-3.0-or-later.<br><br>") +
           QStringLiteral("<table>%1</table><br>").arg(rows) + tr("Licences: ") +
           ofLibraries.join(", ").toHtmlEscaped() + '.';
}

}  // namespace extremal
