// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the handbook's page of Filon's rules and its picture: tool.filon PAGE.md PICTURE.svg
#include <QApplication>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "tests/tools/filon_table.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::tools {
namespace {

/// The largest error within 15 % of z, so that the phase of the oscillation does not show.
double errorAround(const FilonColumn& column, double z) {
    constexpr int places = 60;
    double most = 0;
    for (int i = 0; i <= places; ++i)
        most = std::max(most,
                        filonError(column.nodes, column.count, 1, z * std::pow(1.15, 2.0 * i / places - 1)));
    return std::max(most, 1e-17);
}

Figure picture() {
    Figure figure;
    figure.view = "filon";
    figure.title = "Error of Filon's rules";
    figure.x = {"hω", true, false, std::pair{1e-2, 1e6}};
    figure.y = {"|Q − I|", true, false, std::pair{1e-16, 1e-1}};
    figure.put(RoundOffFloor{filonFloor});
    int style = 0;
    for (const FilonColumn& column : filonColumns()) {
        Series s;
        s.label = column.name;
        s.style = style++;
        for (int i = 0; i <= 160; ++i) {
            const double z = std::pow(10, -2 + i / 20.0);
            s.x.push_back(z);
            s.y.push_back(errorAround(column, z));
        }
        figure.add(std::move(s));
    }
    return figure;
}

}  // namespace
}  // namespace extremal::tools

int main(int count, char** arguments) {
    if (count != 3) {
        std::fprintf(stderr, "usage: %s PAGE.md PICTURE.svg\n", arguments[0]);
        return 2;
    }
    qputenv("QT_QPA_PLATFORM", "offscreen");
    const QApplication application(count, arguments);
    extremal::loadFonts();
    const QString wrong =
        extremal::saveFigure(QString::fromLocal8Bit(arguments[2]), extremal::tools::picture(), {720, 420},
                             extremal::Theme::light(), 1, {false, true, false, {}});  // the page has a title
    if (!wrong.isEmpty()) {
        std::fprintf(stderr, "%s: %s\n", arguments[2], qPrintable(wrong));
        return 1;
    }
    std::ofstream file(arguments[1], std::ios::binary);
    file << extremal::tools::filonPage();
    return file.flush() ? 0 : 1;
}
