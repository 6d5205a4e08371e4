#include "ui/shell/about.hpp"

#include <QCoreApplication>

#include <string>
#include <utility>
#include <vector>

#include "engine/core/instruction_set.hpp"
#include "engine/core/libraries.hpp"

namespace extremal {

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
    return tr("<b>Extremal</b><br>Generalized Galerkin variational integrators: pick a function space and a "
              "quadrature rule; the stationarity of the discrete action is the integrator.<br><br>"
              "GPL-3.0-or-later.<br><br>") +
           QStringLiteral("<table>%1</table>").arg(rows);
}

}  // namespace extremal
