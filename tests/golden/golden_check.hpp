/// Comparing a picture with the kept one of the same name in tests/golden.
///
///     const GoldenResult result = checkGolden(image, "stage-pendulum", GoldenLimits::stage());
///     QVERIFY2(result.isEqual, qPrintable(result.message));
///
/// A failure writes NAME.actual.png, NAME.expected.png, NAME.difference.png and NAME.html (all side by side)
/// into the build's tests/output/golden. Kept pictures change only with EXTREMAL_UPDATE_GOLDEN=1 in the
/// environment, which is refused where CI is set: look at what changed, and commit it with the reason.
#pragma once

#include <QDir>
#include <QFile>
#include <QImage>
#include <QString>

#include "ui/stage/image_compare.hpp"

namespace extremal {

struct GoldenLimits {
    int threshold = 8;              ///< of 255, in one channel
    double differingPercent = 0.1;  ///< of the pixels may differ by more
    double ssim = 0;                ///< the least that is taken

    static GoldenLimits plot() { return {8, 0.1, 0}; }
    static GoldenLimits stage() { return {16, 1.0, 0.98}; }
};

struct GoldenResult {
    bool isEqual = false;
    QString message;
};

inline bool isWithin(const ImageDifference& d, const GoldenLimits& limits) {
    return d.hasSameSize && d.differingPercent <= limits.differingPercent && d.ssim >= limits.ssim;
}

namespace golden {

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
        page.write(QStringLiteral("<!doctype html><meta charset=\"utf-8\"><title>%1</title>"
                                  "<body style=\"font-family:sans-serif;background:#f3f4f6\"><h1>%1</h1>"
                                  "<p>%2 % of the pixels differ, largest difference %3, SSIM %4</p>"
                                  "<img src=\"%1.side-by-side.png\">\n")
                       .arg(name)
                       .arg(d.differingPercent, 0, 'f', 4)
                       .arg(d.largest)
                       .arg(d.ssim, 0, 'f', 5)
                       .toUtf8());
}

}  // namespace golden

inline GoldenResult checkGolden(
    const QImage& actual, const QString& name, const GoldenLimits& limits,
    const QString& keptFolder = QStringLiteral(EXTREMAL_SOURCE_DIR "/tests/golden"),
    const QString& outputFolder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/golden")) {
    const QString kept = keptFolder + "/" + name + ".png";
    if (golden::isSet("EXTREMAL_UPDATE_GOLDEN")) {
        if (golden::isSet("CI")) return {false, "EXTREMAL_UPDATE_GOLDEN is refused where CI is set"};
        return {actual.save(kept), "cannot write " + kept};
    }
    const QImage expected(kept);
    if (expected.isNull())
        return {false, "there is no picture " + kept +
                           " yet: make it with EXTREMAL_UPDATE_GOLDEN=1, look at it, commit it"};
    const ImageDifference d = compareImages(actual, expected, limits.threshold);
    if (isWithin(d, limits)) return {true, {}};
    golden::writePage(outputFolder, name, actual, expected, d);
    return {false, QStringLiteral("%1: %2 % of the pixels differ, SSIM %3; see %4/%1.html")
                       .arg(name)
                       .arg(d.differingPercent, 0, 'f', 3)
                       .arg(d.ssim, 0, 'f', 4)
                       .arg(outputFolder)};
}

}  // namespace extremal
