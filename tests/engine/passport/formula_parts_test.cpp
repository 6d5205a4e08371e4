// SPDX-License-Identifier: GPL-3.0-or-later
/// Indices, exponents and variables in plain formulas.
#include <QTest>

#include "engine/passport/document.hpp"
#include "engine/passport/formula_parts.hpp"
#include "tests/tools/test.hpp"

namespace extremal::formula_parts_test {
namespace {

/// "a[_t][^2]", variables as "<a>".
std::string shown(std::string_view plain, bool isFormula) {
    std::string text;
    for (const FormulaPart& part : formulaParts(plain, isFormula)) {
        const std::string inside = part.isVariable ? "<" + part.text + ">" : part.text;
        text += part.script == Script::none      ? inside
                : part.script == Script::lowered ? "[_" + inside + "]"
                                                 : "[^" + inside + "]";
    }
    return text;
}

}  // namespace

class FormulaPartsTest : public QObject {
    Q_OBJECT
private slots:
    void partsAreTold_data() {
        QTest::addColumn<QString>("plain");
        QTest::addColumn<bool>("isFormula");
        QTest::addColumn<QString>("parts");
        const auto row = [](const char* name, const char* plain, bool isFormula, const char* parts) {
            QTest::newRow(name) << QString::fromUtf8(plain) << isFormula << QString::fromUtf8(parts);
        };
        row("text", "Störmer-Verlet, 2 steps", false, "Störmer-Verlet, 2 steps");
        row("index and exponent", "a_t^2", false, "a[_t][^2]");
        row("braces go", "Y_1, …, Y_{m−1}", false, "Y[_1], …, Y[_m−1]");
        row("round brackets stay", "f^(4)(f, f)", false, "f[^(4)](f, f)");
        row("words are no index", "max_iterations", false, "max_iterations");
        row("two characters are an index", "x_10^2n, x_abc", false, "x[_10][^2n], x_abc");
        row("a brace that is left open", "x_{a", false, "x_{a");
        row("nothing follows", "x_ y^", false, "x_ y^");
        row("variables", "S(q_0, q_1) = h Σ_i b_i L(t_0 + c_i h)", true,
            "<S>(<q>[_0], <q>[_1]) = <h> Σ[_<i>] <b>[_<i>] <L>(<t>[_0] + <c>[_<i>] <h>)");
        row("words are none", "0 a cos(b)", true, "0 <a> cos(<b>)");
    }
    void partsAreTold() {
        QFETCH(QString, plain);
        QFETCH(bool, isFormula);
        QFETCH(QString, parts);
        const std::string text = plain.toStdString();
        QCOMPARE(QString::fromStdString(shown(text, isFormula)), parts);
        // Nothing is lost: the parts stand for all of the text.
        std::size_t at = 0;
        for (const FormulaPart& part : formulaParts(text, isFormula)) {
            QCOMPARE(part.from, at);
            at += part.length;
        }
        QCOMPARE(at, text.size());
    }
    void pagesSetThem() {
        const Document page{"x_1 & y",
                            {Document::Paragraph{"with a_t^2 < 1"},
                             Document::Formulas{{{"p_{m−1} = h b_i", "p_{m-1} = h b_i"}}},
                             Document::Table{{"n"}, {{"u_i"}}}}};
        const std::string html = written(page, PageFormat::html);
        for (const char* part : {"<p>with a<sub>t</sub><sup>2</sup> &lt; 1</p>",
                                 "<i>p</i><sub>m−1</sub> = <i>h</i> <i>b</i><sub><i>i</i></sub>",
                                 "<td>u<sub>i</sub></td>", "<title>x_1 &amp; y</title>"})
            QVERIFY2(html.find(part) != std::string::npos, (std::string(part) + "\n" + html).c_str());
        const std::string tex = written(page, PageFormat::latex);
        for (const char* part : {"with a$_{t}$$^{2}$", "p_{m-1} = h b_i"})
            QVERIFY2(tex.find(part) != std::string::npos, (std::string(part) + "\n" + tex).c_str());
    }
};

EXTREMAL_TEST(FormulaPartsTest)

}  // namespace extremal::formula_parts_test

#include "formula_parts_test.moc"
