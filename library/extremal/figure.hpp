// SPDX-License-Identifier: GPL-3.0-or-later
/// The plots of a comparison or of a study, as data and as SVG.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "extremal/run.hpp"

namespace extremal::api {

/// One curve: of a scheme, or a formula. NaN is a gap. The spans are valid as long as a copy of the figure
/// lives.
struct Curve {
    std::string label;
    std::span<const double> x, y;
};

class EXTREMAL_API Figure {
public:
    const std::string& view() const;  ///< "energy", "phase", ...
    const std::string& title() const;
    const std::string& xTitle() const;  ///< with symbol and unit
    const std::string& yTitle() const;
    const std::string& summary() const;  ///< one sentence
    std::vector<Curve> curves() const;
    /// A picture of the figure with its legend, without any script or outside file.
    std::string svg(int width = 640, int height = 400, bool isDark = false) const;
    /// Its data: "scheme,X,Y".
    std::string csv() const;

    struct Data;
    explicit Figure(std::shared_ptr<const Data> data);

private:
    std::shared_ptr<const Data> data_;
};

/// Every plot that the scene asks for.
EXTREMAL_API std::vector<Figure> figures(const Comparison& comparison);
/// One of them, or another view that needs nothing besides the rows of the run. Throws InvalidScene where
/// there is no such view, or the scene cannot show it.
EXTREMAL_API Figure figure(const Comparison& comparison, const std::string& view);

}  // namespace extremal::api
