// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/tickers.hpp"

#include <QFontMetricsF>

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace extremal {

QString powerOfTen(int exponent) {
    static const QString digits = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString text = QStringLiteral("10");
    if (exponent < 0) text += QChar(0x207b);
    for (const QChar& c : QString::number(std::abs(exponent))) text += digits[c.digitValue()];
    return text;
}

namespace {

QString withRealMinus(QString text) { return text.replace(QLatin1Char('-'), QChar(0x2212)); }

/// Fixed digits without trailing zeros.
QString plain(double value, int decimals) {
    QString text = QString::number(value, 'f', std::clamp(decimals, 0, 15));
    if (text.contains(QLatin1Char('.'))) {
        while (text.endsWith(QLatin1Char('0'))) text.chop(1);
        if (text.endsWith(QLatin1Char('.'))) text.chop(1);
    }
    return withRealMinus(text);
}

}  // namespace

QString tickText(double value, double step) {
    if (std::abs(value) < 1e-9 * step) return QStringLiteral("0");
    const int stepExponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    const int decimals = std::max(0, 1 - stepExponent);  // steps are 1, 2, 2.5, 5 times a power of ten
    const bool isLong = exponent >= 5 || (exponent < -3 && stepExponent < -3) || stepExponent < -12;
    if (!isLong) return plain(value, decimals);
    const QString mantissa = plain(value / std::pow(10.0, exponent), exponent - stepExponent + 1);
    if (mantissa == QLatin1String("1")) return powerOfTen(exponent);
    return mantissa + QChar(0x00d7) + powerOfTen(exponent);
}

namespace {

constexpr int leastTicks = 3;

class LinearTicker : public QCPAxisTicker {
public:
    explicit LinearTicker(int room, LabelRoom labels = {})
        : room_(std::max(1, room)), labelRoom_(std::move(labels)) {}

    void generate(const QCPRange& range, const QLocale& locale, QChar format, int precision,
                  QVector<double>& ticks, QVector<double>* subTicks, QVector<QString>* labels) override {
        QCPAxisTicker::generate(range, locale, format, precision, ticks, subTicks, labels);
        if (labels && labelRoom_.length > 0) thinOut(range, ticks, *labels);
    }

protected:
    /// The smallest of 1, 2, 2.5, 5 times a power of ten that gives no more ticks than there is room for; a
    /// smaller one where that would leave fewer than three.
    double getTickStep(const QCPRange& range) override {
        const double atLeast = range.size() / room_;
        const double power = std::pow(10.0, std::floor(std::log10(atLeast)));
        constexpr std::array steps{0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 2.5, 5.0, 10.0};
        std::size_t i = 4;
        while (i + 1 < steps.size() && steps[i] * power < atLeast * (1 - 1e-9)) ++i;
        while (i > 0 && ticksIn(range, steps[i] * power) < leastTicks) --i;
        return step_ = steps[i] * power;
    }
    /// A tick at the very end of the range is not lost to round-off.
    QVector<double> createTickVector(double step, const QCPRange& range) override {
        QVector<double> ticks = QCPAxisTicker::createTickVector(step, range);
        for (double& tick : ticks)
            for (const double end : {range.lower, range.upper})
                if (std::abs(tick - end) < slack * step) tick = end;
        return ticks;
    }
    int getSubTickCount(double) override { return 0; }
    QString getTickLabel(double tick, const QLocale&, QChar, int) override { return tickText(tick, step_); }

private:
    static constexpr double slack = 1e-9;
    /// Long numbers on a short axis: only those ticks have one at which they do not touch.
    void thinOut(const QCPRange& range, const QVector<double>& ticks, QVector<QString>& labels) const {
        constexpr double gap = 6;  // pixels
        const QFontMetricsF metrics(labelRoom_.font);
        double widest = 0;
        for (const QString& label : labels) widest = std::max(widest, metrics.horizontalAdvance(label));
        const double every = std::ceil((widest + gap) * range.size() / (labelRoom_.length * step_));
        for (qsizetype i = 0; i < labels.size(); ++i)
            if (std::abs(std::remainder(std::round(ticks[i] / step_), every)) > 0.5) labels[i].clear();
    }
    static int ticksIn(const QCPRange& range, double step) {
        return static_cast<int>(std::floor(range.upper / step + slack) -
                                std::ceil(range.lower / step - slack)) +
               1;
    }
    int room_;
    LabelRoom labelRoom_;
    double step_ = 1;
};

/// Powers of ten; within a decade also 2 and 5 times them; on less than a factor of two, and where these are
/// fewer than three, equidistant ticks.
class LogTicker : public QCPAxisTicker {
public:
    explicit LogTicker(int room) : room_(std::max(1, room)) {}

    void generate(const QCPRange& range, const QLocale&, QChar, int, QVector<double>& ticks,
                  QVector<double>* subTicks, QVector<QString>* labels) override {
        ticks.clear();
        if (subTicks) subTicks->clear();
        if (labels) labels->clear();
        if (!(range.lower > 0) || !(range.upper > range.lower)) return;
        const double low = std::log10(range.lower), high = std::log10(range.upper);
        const auto add = [&](double value, const QString& text) {
            ticks.push_back(value);
            if (labels) labels->push_back(text);
        };
        const auto clear = [&] {
            ticks.clear();
            if (subTicks) subTicks->clear();
            if (labels) labels->clear();
        };
        if (high - low >= 1.5) {
            decades(low, high, add, subTicks);
            if (ticks.size() >= leastTicks) return;
            clear();
        }
        if (high - low > 0.3)
            for (const std::vector<int>& factors : {std::vector{1, 3}, std::vector{1, 2, 5}}) {
                clear();
                // Without room, a multiple of a power of ten that stands beside it is the factor alone.
                const bool isTight = (high - low) * static_cast<double>(factors.size()) > room_ - 1;
                const bool hasPower = std::floor(high + 1e-12) >= std::ceil(low - 1e-12);
                for (int e = static_cast<int>(std::floor(low)); e <= static_cast<int>(std::ceil(high)); ++e)
                    for (const int m : factors) {
                        const double value = m * std::pow(10.0, e);
                        if (value < range.lower * (1 - 1e-12) || value > range.upper * (1 + 1e-12)) continue;
                        add(value, m == 1 ? powerOfTen(e)
                                   : isTight && hasPower
                                       ? QString::number(m)
                                       : QString::number(m) + QChar(0x00d7) + powerOfTen(e));
                    }
                if (ticks.size() >= leastTicks && (factors.size() > 2 || high - low >= 1.5)) return;
            }
        if (ticks.size() < leastTicks) {
            clear();
            QVector<double> even;
            QVector<QString> evenLabels;
            LinearTicker(std::clamp(room_, leastTicks, 4))
                .generate(range, QLocale::c(), QLatin1Char('g'), 6, even, nullptr, &evenLabels);
            for (qsizetype i = 0; i < even.size(); ++i)
                if (even[i] >= range.lower && even[i] <= range.upper) add(even[i], evenLabels[i]);
        }
    }

private:
    template <class Add>
    void decades(double low, double high, const Add& add, QVector<double>* subTicks) const {
        int step = 1;
        for (int candidate : {1, 2, 3, 4, 5, 10, 20, 50, 100}) {
            step = candidate;
            if ((high - low) / candidate <= room_) break;
        }
        const auto shownIn = [&](int by) {
            return std::floor((high + 1e-9) / by) - std::ceil((low - 1e-9) / by) + 1;
        };
        while (step > 1 && shownIn(step) < leastTicks) step = step > 5 ? step / 2 : step - 1;
        const int first = static_cast<int>(std::ceil(low - 1e-9)),
                  last = static_cast<int>(std::floor(high + 1e-9));
        for (int e = first - 1; e <= last; ++e) {
            const bool isShown = e >= first;
            if (isShown && ((e % step) + step) % step == 0)
                add(std::pow(10.0, e), powerOfTen(e));
            else if (isShown && subTicks && step <= 3)
                subTicks->push_back(std::pow(10.0, e));
            if (step != 1 || !subTicks || high - low > 0.6 * room_) continue;
            for (int m = 2; m <= 9; ++m) {
                const double value = m * std::pow(10.0, e);
                if (std::log10(value) >= low && std::log10(value) <= high) subTicks->push_back(value);
            }
        }
    }
    int room_;
};

}  // namespace

QSharedPointer<QCPAxisTicker> linearTicker(int room, const LabelRoom& labels) {
    return QSharedPointer<QCPAxisTicker>(new LinearTicker(room, labels));
}
QSharedPointer<QCPAxisTicker> logTicker(int room) {
    return QSharedPointer<QCPAxisTicker>(new LogTicker(room));
}

QSharedPointer<QCPAxisTicker> namedTicker(const std::vector<std::pair<double, std::string>>& names,
                                          double least) {
    auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    double last = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [place, name] : names) {
        if (std::abs(place - last) < least) continue;
        ticker->addTick(place, QString::fromStdString(name));
        last = place;
    }
    return ticker;
}

}  // namespace extremal
