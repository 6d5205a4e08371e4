// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/image/digest.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/figure/build.hpp"
#include "engine/figure/sample.hpp"

namespace extremal {
namespace {

std::string nineDigits(double value) {
    if (std::isnan(value)) return "gap";
    std::array<char, 40> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9);
    return {buffer.data(), end.ptr};
}

/// FNV-1a over the values as multiples of 1e-9 of the largest power of ten in the series.
std::string hash(std::span<const double> values) {
    const double largest = maxMagnitude(values);
    const double quantum = largest > 0 ? std::pow(10, std::ceil(std::log10(largest)) - 9) : 1;
    std::uint64_t h = 14695981039346656037u;
    for (double v : values) {
        const std::int64_t rounded = std::isfinite(v) ? std::llround(v / quantum) : INT64_MIN;
        for (int byte = 0; byte < 8; ++byte) {
            h ^= (static_cast<std::uint64_t>(rounded) >> (8 * byte)) & 0xff;
            h *= 1099511628211u;
        }
    }
    std::array<char, 20> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), h, 16);
    return {buffer.data(), end.ptr};
}

std::string axisLine(const char* name, const Axis& axis) {
    std::string line =
        std::string(name) + ": " + axis.title + (axis.isLog ? " | log" : "") + (axis.isTime ? " | time" : "");
    if (axis.range) line += " | " + nineDigits(axis.range->first) + " .. " + nineDigits(axis.range->second);
    return line + "\n";
}

}  // namespace

std::string digest(const Figure& figure) {
    std::string text = figure.view + ": " + figure.title + " (" + figure.subtitle + ")\n";
    text += axisLine("x", figure.x) + axisLine("y", figure.y);
    for (const Series& s : figure.series()) {
        text += "series " + std::to_string(s.style) + " " + seriesName(s) + ": " +
                std::to_string(s.x.size()) + " points, " + std::to_string(s.hidden) + " hidden" +
                (isParametric(s.kind) ? ", curve" : "") + (hasMarks(s.kind) ? ", markers" : "") +
                (hasLine(s.kind) ? ", line" : "") + (s.kind == SeriesKind::cells ? ", cells" : "") +
                (s.kind == SeriesKind::ticks ? ", ticks" : "") + (s.tone == Tone::pale ? ", pale" : "") +
                (s.shade ? ", shade " + nineDigits(*s.shade) : "") + ", x " + hash(s.x) + ", y " + hash(s.y) +
                ", largest " + nineDigits(maxMagnitude(s.y)) + "\n";
    }
    if (figure.heat())
        text += "heat " + std::to_string(figure.heat()->columns) + " x " +
                std::to_string(figure.heat()->rows) + ", " + nineDigits(figure.heat()->low) + " .. " +
                nineDigits(figure.heat()->high) + ", " + hash(figure.heat()->values) +
                (figure.heat()->scale.empty() ? "" : ", " + figure.heat()->scale) + "\n";
    for (const FailureMark& f : figure.all<FailureMark>())
        text += "failure " + std::to_string(f.style) + " " + f.label + ": " + f.text + ", " +
                nineDigits(f.x) + "\n";
    for (const EventMarks& m : figure.all<EventMarks>())
        text += "events " + std::to_string(m.style) + " " + m.label + ": " + m.text + ", " +
                std::to_string(m.x.size()) + " marks, x " + hash(m.x) + ", y " + hash(m.y) + "\n";
    if (const ColourScale* scale = figure.find<ColourScale>())
        text += "colours " + scale->title + ", " + nineDigits(scale->low) + " .. " + nineDigits(scale->high) +
                "\n";
    if (figure.find<RoundOffFloor>()) text += "floor " + nineDigits(floorOf(figure)) + "\n";
    if (const DoubtfulBand* band = figure.find<DoubtfulBand>())
        text += "doubtful below " + nineDigits(band->top) + "\n";
    for (const Guide& g : figure.all<Guide>())
        text += std::string("guide") + (g.isStrong ? ", strong" : "") + ", x " + hash(g.x) + ", y " +
                hash(g.y) + "\n";
    for (const Label& l : figure.all<Label>())
        text += "label " + l.text + " at " + nineDigits(l.x) + ", " + nineDigits(l.y) + "\n";
    if (figure.axes == AxisStyle::none) text += "no ticks\n";
    if (figure.aspect == Aspect::equal) text += "equal scales\n";
    if (!figure.message.empty()) text += "message " + figure.message + "\n";
    return text + "summary " + figure.summary + "\n";
}

}  // namespace extremal
