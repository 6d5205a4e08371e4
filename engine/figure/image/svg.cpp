// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/image/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/image/faded_cell.hpp"
#include "engine/figure/image/palette.hpp"
#include "engine/figure/image/png.hpp"
#include "engine/figure/sample.hpp"

namespace extremal {
namespace {

struct Colours {
    const char *ground, *text, *muted, *grid, *line, *error;
    const std::array<const char*, 8>& series;
};
Colours coloursOf(bool isDark) {
    return isDark ? Colours{"#1B1F26", "#E6E9EE", "#98A2AE", "#2A303A", "#3A424E", "#FF8A80", darkSeries}
                  : Colours{"#FFFFFF", "#1F2328", "#636C78", "#ECEEF1", "#C6CBD2", "#B42318", lightSeries};
}

using Rgb = std::array<double, 3>;
Rgb rgbOf(const char* hex) {
    const auto digit = [&](std::size_t i) { return hex[i] <= '9' ? hex[i] - '0' : (hex[i] | 32) - 'a' + 10; };
    return {(16 * digit(1) + digit(2)) / 255.0, (16 * digit(3) + digit(4)) / 255.0,
            (16 * digit(5) + digit(6)) / 255.0};
}

/// Pixels, to a tenth.
std::string px(double value) { return formatNumber(std::round(std::clamp(value, -1e5, 1e5) * 10) / 10); }

/// An axis in pixels.
struct Scale {
    double low = 0, high = 1, from = 0, to = 1;
    bool isLog = false;

    double at(double value) const {
        const double part =
            isLog ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        return from + part * (to - from);
    }
    bool shows(double value) const { return std::isfinite(value) && (!isLog || value > 0); }
};

Scale scaleOf(const Axis& axis, double from, double to) {
    const auto [low, high] = axis.range.value_or(std::pair(0.0, 1.0));
    return {low, high, from, to, axis.isLog};
}

std::string power(int exponent) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return text;
}

/// Ticks at round places: 1, 2 or 5 times a power of ten, or powers of ten. `room`: how many fit.
std::vector<std::pair<double, std::string>> ticksOf(const Axis& axis, const Scale& scale, int room) {
    if (!axis.ticks.empty()) return axis.ticks;
    std::vector<std::pair<double, std::string>> ticks;
    if (scale.isLog) {
        const int first = static_cast<int>(std::ceil(std::log10(scale.low) - 1e-9)),
                  last = static_cast<int>(std::floor(std::log10(scale.high) + 1e-9));
        const int apart = std::max(1, (last - first) / std::max(1, room) + 1);
        if (last - first >= 1) {
            for (int e = first; e <= last; e += apart) ticks.emplace_back(std::pow(10, e), power(e));
            return ticks;
        }
    }
    const double width = scale.high - scale.low, rough = width / std::max(1, room);
    if (!(rough > 0)) return ticks;
    const double unit = std::pow(10, std::floor(std::log10(rough)));
    const double step = rough <= unit       ? unit
                        : rough <= 2 * unit ? 2 * unit
                        : rough <= 5 * unit ? 5 * unit
                                            : 10 * unit;
    for (double k = std::ceil(scale.low / step - 1e-9); k * step <= scale.high + 1e-9 * width; ++k) {
        const double value = std::abs(k) < 0.5 ? 0 : k * step;
        std::string label = formatNumber(value, 6);
        if (label.front() == '-') label.replace(0, 1, "−");
        ticks.emplace_back(value, label);
    }
    return ticks;
}

class Picture {
public:
    Picture(const Figure& figure, const SvgOptions& options)
        : figure_(figure),
          width_(std::max(160, options.width)),
          height_(std::max(120, options.height)),
          colours_(coloursOf(options.isDark)) {
        const bool hasScales = figure.axes == AxisStyle::scales;
        left_ = hasScales ? 62 : 12;
        right_ = width_ - 14.0;
        top_ = figure.subtitle.empty() ? 34 : 48;
        legend_ = legendRows();
        bottom_ = height_ - (hasScales ? 42.0 : 12.0) - 17.0 * static_cast<double>(legend_.size());
        bottom_ = std::max(bottom_, top_ + 20);
        x_ = scaleOf(figure.x, left_, right_);
        y_ = scaleOf(figure.y, bottom_, top_);
        if (figure.aspect == Aspect::equal && !x_.isLog && !y_.isLog) keepAspect();
    }

    std::string text() {
        out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width_) +
               "\" height=\"" + std::to_string(height_) + "\" viewBox=\"0 0 " + std::to_string(width_) + " " +
               std::to_string(height_) +
               "\" font-family=\"Inter, Helvetica, Arial, sans-serif\" role=\"img\">\n";
        out_ += "<title>" + markupText(figure_.title) + "</title>\n<desc>" + markupText(figure_.summary) +
                "</desc>\n";
        out_ += "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string(colours_.ground) + "\"/>\n";
        word(left_, 20, figure_.title, colours_.text, "start", 14, "font-weight=\"600\"");
        if (!figure_.subtitle.empty()) word(left_, 37, figure_.subtitle, colours_.muted, "start", 11);
        // Two pictures on one page must not share names: the clip is a nested <svg>.
        const bool isEmptyFigure = isEmpty(figure_) && !figure_.message.empty();
        if (figure_.axes == AxisStyle::scales) axes();
        out_ += "<svg x=\"" + px(left_) + "\" y=\"" + px(top_) + "\" width=\"" + px(right_ - left_) +
                "\" height=\"" + px(bottom_ - top_) + "\" viewBox=\"" + px(left_) + " " + px(top_) + " " +
                px(right_ - left_) + " " + px(bottom_ - top_) + "\">\n";
        for (const HeatMap& heat : figure_.all<HeatMap>()) draw(heat);
        for (const DoubtfulBand& band : figure_.all<DoubtfulBand>()) draw(band);
        for (const RoundOffFloor& floor : figure_.all<RoundOffFloor>()) draw(floor);
        for (const Guide& guide : figure_.all<Guide>())
            path(guide.x, guide.y, false, guide.isStrong ? colours_.muted : colours_.line,
                 guide.isBroad ? 6 : 1, "opacity=\"0.7\"");
        for (const Area& area : figure_.all<Area>()) draw(area);
        for (const Series& series : figure_.all<Series>()) draw(series);
        for (const EventMarks& marks : figure_.all<EventMarks>()) draw(marks);
        for (const FailureMark& mark : figure_.all<FailureMark>()) draw(mark);
        for (const Label& label : figure_.all<Label>())
            if (x_.shows(label.x) && y_.shows(label.y))
                word(x_.at(label.x) + 3, y_.at(label.y) - 3, label.text, colours_.muted, "start", 11);
        out_ += "</svg>\n";
        if (isEmptyFigure)
            word((left_ + right_) / 2, (top_ + bottom_) / 2, figure_.message, colours_.muted, "middle", 12);
        drawLegend();
        return out_ + "</svg>\n";
    }

    SvgFrame frame() const {
        return {left_, right_, top_, bottom_, {x_.low, x_.high}, {y_.low, y_.high}, x_.isLog, y_.isLog};
    }

private:
    void keepAspect() {
        const double perX = (x_.high - x_.low) / (right_ - left_),
                     perY = (y_.high - y_.low) / (bottom_ - top_);
        Scale& wider = perX < perY ? x_ : y_;
        const double factor = perX < perY ? perY / perX : perX / perY;
        const double middle = (wider.low + wider.high) / 2, half = (wider.high - wider.low) / 2 * factor;
        wider.low = middle - half;
        wider.high = middle + half;
    }
    std::string colourOf(int style) const {
        if (style == formulaStyle) return colours_.muted;
        if (style == exactStyle) return colours_.text;
        return colours_.series[static_cast<std::size_t>(std::max(0, style)) % colours_.series.size()];
    }
    static std::string dashOf(int style) {
        if (style == formulaStyle) return "stroke-dasharray=\"5 4\"";
        static constexpr const char* dashes[] = {"",      "9 4",  "9 3 2 3",     "4 3",
                                                 "2 2.5", "15 4", "9 3 2 3 2 3", "9 3 4 3"};
        const char* dash = style < 0 ? "" : dashes[(style + 3 * (style / 8)) % 8];
        return *dash ? "stroke-dasharray=\"" + std::string(dash) + "\"" : "";
    }
    void word(double x, double y, const std::string& text, const std::string& colour, const char* anchor,
              int size, const std::string& more = {}) {
        if (text.empty()) return;
        out_ += "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" fill=\"" + colour + "\" text-anchor=\"" +
                anchor + "\" font-size=\"" + std::to_string(size) + "\" " + more + ">" + markupText(text) +
                "</text>\n";
    }
    void line(double x1, double y1, double x2, double y2, const std::string& colour,
              const std::string& more = {}) {
        out_ += "<path d=\"M" + px(x1) + " " + px(y1) + "L" + px(x2) + " " + px(y2) + "\" stroke=\"" +
                colour + "\" fill=\"none\" " + more + "/>\n";
    }
    void dot(double x, double y, double radius, const std::string& colour) {
        out_ += "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"" + px(radius) + "\" fill=\"" +
                colour + "\"/>\n";
    }

    void axes() {
        for (const auto& [value, label] : ticksOf(figure_.x, x_, static_cast<int>((right_ - left_) / 75))) {
            const double x = x_.at(value);
            if (!(x >= left_ - 0.5 && x <= right_ + 0.5)) continue;
            line(x, top_, x, bottom_, colours_.grid);
            word(x, bottom_ + 15, label, colours_.muted, "middle", 11);
        }
        for (const auto& [value, label] : ticksOf(figure_.y, y_, static_cast<int>((bottom_ - top_) / 36))) {
            const double y = y_.at(value);
            if (!(y >= top_ - 0.5 && y <= bottom_ + 0.5)) continue;
            line(left_, y, right_, y, colours_.grid);
            word(left_ - 6, y + 4, label, colours_.muted, "end", 11);
        }
        out_ += "<rect x=\"" + px(left_) + "\" y=\"" + px(top_) + "\" width=\"" + px(right_ - left_) +
                "\" height=\"" + px(bottom_ - top_) + "\" fill=\"none\" stroke=\"" + colours_.line + "\"/>\n";
        word((left_ + right_) / 2, bottom_ + 32, figure_.x.title, colours_.text, "middle", 12);
        const std::string place = px(15) + " " + px((top_ + bottom_) / 2);
        word(15, (top_ + bottom_) / 2, figure_.y.title, colours_.text, "middle", 12,
             "transform=\"rotate(-90 " + place + ")\"");
    }

    /// The points of a line in pixels. Where x grows, at most four points per column of pixels remain (first,
    /// lowest, highest, last: the picture is the same); of other curves those closer than a third of a pixel
    /// go.
    void path(std::span<const double> xs, std::span<const double> ys, bool isParametric,
              const std::string& colour, double width, const std::string& more) {
        std::string d;
        struct Point {
            double x, y;
        };
        std::vector<Point> column;
        Point last{1e9, 1e9};
        bool isOpen = false;
        const auto put = [&](Point p) {
            d += (isOpen ? "L" : "M") + px(p.x) + " " + px(p.y);
            isOpen = true;
            last = p;
        };
        const auto flush = [&] {
            if (column.empty()) return;
            const auto [low, high] = std::minmax_element(
                column.begin(), column.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
            std::set<std::size_t> kept{0, static_cast<std::size_t>(low - column.begin()),
                                       static_cast<std::size_t>(high - column.begin()), column.size() - 1};
            for (const std::size_t i : kept) put(column[i]);
            column.clear();
        };
        for (std::size_t i = 0; i < xs.size() && i < ys.size(); ++i) {
            if (!x_.shows(xs[i]) || !y_.shows(ys[i])) {
                flush();
                isOpen = false;
                continue;
            }
            const Point p{x_.at(xs[i]), y_.at(ys[i])};
            if (isParametric) {
                if (!isOpen || i + 1 == xs.size() || std::hypot(p.x - last.x, p.y - last.y) > 0.33) put(p);
                continue;
            }
            if (!column.empty() && std::floor(column.front().x) != std::floor(p.x)) flush();
            column.push_back(p);
        }
        flush();
        if (!d.empty())
            out_ += "<path d=\"" + d + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" +
                    px(width) + "\" stroke-linejoin=\"round\" " + more + "/>\n";
    }

    void draw(const Series& s) {
        const std::string colour = colourOf(s.style), faint = s.tone == Tone::pale ? "opacity=\"0.45\"" : "";
        if (hasLine(s.kind) && !s.isSparse)
            path(s.x, s.y, isParametric(s.kind), colour, 1.6, dashOf(s.style) + " " + faint);
        const bool hasDots = hasMarks(s.kind) || s.isSparse;
        double lastX = 1e9, lastY = 1e9;
        for (std::size_t i = 0; i < s.x.size() && i < s.y.size(); ++i) {
            if (!x_.shows(s.x[i]) || !y_.shows(s.y[i])) continue;
            const double x = x_.at(s.x[i]), y = y_.at(s.y[i]);
            if (s.kind == SeriesKind::cells) {
                const double w = std::abs(x_.at(s.x[i] + 0.5) - x_.at(s.x[i] - 0.5)),
                             h = std::abs(y_.at(s.y[i] + 0.5) - y_.at(s.y[i] - 0.5));
                out_ += "<rect x=\"" + px(x - w / 2) + "\" y=\"" + px(y - h / 2) + "\" width=\"" + px(w) +
                        "\" height=\"" + px(h) + "\" fill=\"" + colour + "\" " + faint + "/>\n";
            } else if (s.kind == SeriesKind::ticks) {
                line(x, y - 4, x, y + 4, colour, faint);
            } else if (hasDots && std::hypot(x - lastX, y - lastY) > 0.5) {
                dot(x, y, hasLine(s.kind) ? 2.4 : 1.6, colour);
                lastX = x;
                lastY = y;
            }
        }
    }
    void draw(const Area& area) {
        std::string points;
        for (std::size_t i = 0; i < area.x.size() && i < area.y.size(); ++i)
            if (x_.shows(area.x[i]) && y_.shows(area.y[i]))
                points += px(x_.at(area.x[i])) + "," + px(y_.at(area.y[i])) + " ";
        out_ +=
            "<polygon points=\"" + points + "\" fill=\"" + colourOf(area.style) + "\" opacity=\"0.18\"/>\n";
    }
    void draw(const DoubtfulBand& band) {
        if (!y_.shows(band.top)) return;
        const double y = std::max(top_, y_.at(band.top));
        out_ += "<rect x=\"" + px(left_) + "\" y=\"" + px(y) + "\" width=\"" + px(right_ - left_) +
                "\" height=\"" + px(std::max(0.0, bottom_ - y)) + "\" fill=\"" + colours_.grid + "\"/>\n";
    }
    void draw(const RoundOffFloor& floor) {
        if (y_.shows(floor.y) && floor.y > 0)
            line(left_, y_.at(floor.y), right_, y_.at(floor.y), colours_.muted, "stroke-dasharray=\"1 3\"");
    }
    void draw(const FailureMark& mark) {
        if (!x_.shows(mark.x)) return;
        const double x = x_.at(mark.x);
        line(x, top_, x, bottom_, colourOf(mark.style), "stroke-dasharray=\"3 3\"");
        word(x - 4, top_ + 14, mark.label + ": " + mark.text, colours_.error, "end", 11);
    }
    void draw(const EventMarks& marks) {
        for (std::size_t i = 0; i < marks.x.size(); ++i) {
            if (!x_.shows(marks.x[i])) continue;
            const double x = x_.at(marks.x[i]);
            const double y = i < marks.y.size() && y_.shows(marks.y[i]) ? y_.at(marks.y[i]) : bottom_ - 4;
            line(x - 3, y - 3, x + 3, y + 3, colourOf(marks.style));
            line(x - 3, y + 3, x + 3, y - 3, colourOf(marks.style));
        }
    }
    /// As a picture of at most 256 x 256 pixels, each the value of the cell below its middle.
    void draw(const HeatMap& heat) {
        if (heat.columns <= 0 || heat.rows <= 0) return;
        const int columns = std::min(heat.columns, 256), rows = std::min(heat.rows, 256);
        std::vector<std::array<unsigned char, 3>> pixels;
        for (int r = rows - 1; r >= 0; --r)
            for (int c = 0; c < columns; ++c) {
                const int column = (2 * c + 1) * heat.columns / (2 * columns),
                          row = (2 * r + 1) * heat.rows / (2 * rows);
                std::array<unsigned char, 3> pixel{};
                const Rgb colour = colourOf(heat, static_cast<std::size_t>(column * heat.rows + row));
                for (std::size_t i = 0; i < 3; ++i)
                    pixel[i] = static_cast<unsigned char>(std::lround(255 * std::clamp(colour[i], 0.0, 1.0)));
                pixels.push_back(pixel);
            }
        const double x = x_.at(heat.left), y = y_.at(heat.top);
        out_ += "<image x=\"" + px(x) + "\" y=\"" + px(y) + "\" width=\"" + px(x_.at(heat.right) - x) +
                "\" height=\"" + px(y_.at(heat.bottom) - y) + "\" preserveAspectRatio=\"none\" " +
                (heat.scale.empty() ? "" : "image-rendering=\"pixelated\" ") +
                "href=\"data:image/png;base64," + base64(pngOf(columns, pixels)) + "\"/>\n";
    }
    Rgb colourOf(const HeatMap& heat, std::size_t i) const {
        const double value = heat.values[i];
        const Rgb& ground = faded_.ground;
        if (!heat.scale.empty()) {
            if (!std::isfinite(value))
                return heat.faults.empty() || heat.faults[i].empty() ? ground : rgbOf(colours_.error);
            return valueColours(value > 0 ? std::log10(value / heat.low) / std::log10(heat.high / heat.low)
                                          : 0);
        }
        return fadedCell(heat, i, faded_);
    }

    struct Entry {
        std::string name;
        int style;
        double width;
    };
    /// The schemes, in as many rows as their names need.
    std::vector<std::vector<Entry>> legendRows() const {
        std::vector<std::vector<Entry>> rows;
        std::set<std::string> seen;
        double used = 0;
        for (const Series& s : figure_.all<Series>()) {
            const std::string name = s.tone == Tone::pale ? s.label : seriesName(s);
            if (name.empty() || !seen.insert(name).second) continue;
            const double width = 34 + 6.6 * static_cast<double>(codePoints(name));
            if (rows.empty() || used + width > width_ - 24) {
                rows.emplace_back();
                used = 0;
            }
            rows.back().push_back({name, s.style, width});
            used += width;
        }
        return rows;
    }
    void drawLegend() {
        double y = height_ - 17.0 * static_cast<double>(legend_.size()) + 8;
        for (const auto& row : legend_) {
            double x = 14;
            for (const Entry& entry : row) {
                line(x, y - 4, x + 22, y - 4, colourOf(entry.style),
                     "stroke-width=\"2\" " + dashOf(entry.style));
                word(x + 27, y, entry.name, colours_.text, "start", 11);
                x += entry.width;
            }
            y += 17;
        }
    }

    const Figure& figure_;
    int width_, height_;
    Colours colours_;
    FadedColours faded_{rgbOf(colours_.ground), rgbOf(colours_.series[0]), rgbOf(colours_.series[1])};
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
    Scale x_, y_;
    std::vector<std::vector<Entry>> legend_;
    std::string out_;
};

}  // namespace

std::string svgOf(const Figure& figure, const SvgOptions& options) { return Picture(figure, options).text(); }

SvgFrame svgFrame(const Figure& figure, const SvgOptions& options) {
    return Picture(figure, options).frame();
}

std::optional<std::pair<double, double>> SvgFrame::at(double xValue, std::optional<double> yValue) const {
    const Scale across{x.first, x.second, left, right, isXLog}, up{y.first, y.second, bottom, top, isYLog};
    if (!across.shows(xValue) || (yValue && !up.shows(*yValue))) return {};
    const std::pair place(across.at(xValue), yValue ? up.at(*yValue) : top);
    if (place.first < left || place.first > right || place.second < top || place.second > bottom) return {};
    return place;
}

}  // namespace extremal
