// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a picture with the golden image of the same name in tests/golden.
///
///     const GoldenResult result = checkGolden(image, "stage-pendulum", GoldenLimits::stage());
///     QVERIFY2(result.isEqual, qPrintable(result.message));
///
/// A failure writes NAME.actual.png, NAME.expected.png, NAME.difference.png and NAME.html (all side by side)
/// into tests/output/golden of the build folder. Golden images change only with EXTREMAL_UPDATE_GOLDEN=1 in
/// the environment, which is refused if CI is set: look at the changes, and commit them with the reason.
#pragma once

#include <QDir>
#include <QFile>
#include <QImage>
#include <QString>

#include "ui/pictures/image_compare.hpp"

namespace extremal {

/// On one machine equal scenes give equal pictures. The limits leave room for other versions of Mesa and of
/// FreeType along the edges of shapes, but not for a missing shape: golden_teeth_test.cpp removes each one.
struct GoldenLimits {
    int threshold = 8;              ///< of 255, in one channel
    double differingPercent = 0.1;  ///< of all pixels may differ by more
    double worstTilePercent = 2;    ///< of the pixels of any tile of 16 x 16 may (5 of 256)

    static GoldenLimits plot() { return {8, 0.1, 2}; }
    static GoldenLimits stage() { return {8, 0.1, 2}; }
};

struct GoldenResult {
    bool isEqual = false;
    QString message;
};

inline bool isWithin(const ImageDifference& d, const GoldenLimits& limits) {
    return d.hasSameSize && d.differingPercent <= limits.differingPercent &&
           d.worstTilePercent <= limits.worstTilePercent;
}

namespace golden_details {

inline bool isSet(const char* variable) {
    const QByteArray value = qgetenv(variable).toLower();
    return !value.isEmpty() && value != "0" && value != "false";
}

inline void writePage(const QString& folder, const QString& name, const QImage& actual,
                      const QImage& expected, const ImageDifference& d) {
    QDir().mkpath(folder);
    const auto path = [&](const char* kind) { return folder + "/" + name + kind; };
    actual.save(path(".actual.png"));
    expected.save(path(".expected.png"));
    if (!d.picture.isNull()) d.picture.save(path(".difference.png"));
    sideBySide(actual, expected, d).save(path(".side-by-side.png"));
    QFile page(path(".html"));
    if (page.open(QIODevice::WriteOnly))
        page.write(
            QStringLiteral("<!doctype html><meta charset=\"utf-8\"><title>%1</title>"
                           "<body style=\"font-family:sans-serif;background:#f3f4f6\"><h1>%1</h1>"
                           "<p>%2 % of the pixels differ, %3 % of the worst tile; largest difference %4</p>"
                           "<img src=\"%1.side-by-side.png\">\n")
                .arg(name)
                .arg(d.differingPercent, 0, 'f', 4)
                .arg(d.worstTilePercent, 0, 'f', 1)
                .arg(d.largest)
                .toUtf8());
}

}  // namespace golden_details

inline GoldenResult checkGolden(
    const QImage& actual, const QString& name, const GoldenLimits& limits,
    const QString& goldenFolder = QStringLiteral(EXTREMAL_SOURCE_DIR "/tests/golden"),
    const QString& outputFolder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/golden")) {
    const QString golden = goldenFolder + "/" + name + ".png";
    if (golden_details::isSet("EXTREMAL_UPDATE_GOLDEN")) {
        if (golden_details::isSet("CI")) return {false, "EXTREMAL_UPDATE_GOLDEN is refused where CI is set"};
        return {actual.save(golden), "cannot write " + golden};
    }
    const QImage expected(golden);
    if (expected.isNull())
        return {false, "there is no golden image " + golden +
                           " yet: make it with EXTREMAL_UPDATE_GOLDEN=1, look at it, commit it"};
    const ImageDifference d = compareImages(actual, expected, limits.threshold);
    if (isWithin(d, limits)) return {true, {}};
    golden_details::writePage(outputFolder, name, actual, expected, d);
    return {false, QStringLiteral("%1: %2 % of the pixels differ, %3 % of the worst tile; see %4/%1.html")
                       .arg(name)
                       .arg(d.differingPercent, 0, 'f', 3)
                       .arg(d.worstTilePercent, 0, 'f', 1)
                       .arg(outputFolder)};
}

}  // namespace extremal
