/// Reading a figure: values at a time, and its data as CSV.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "engine/figure/figure.hpp"

namespace extremal {

/// The point of a series at a time (of a curve: by its own t), between the two neighbouring samples by straight line;
/// empty outside the samples, at a gap, or if the series has no time.
std::optional<std::pair<double, double>> pointAt(const Series& series, double t);

/// "scheme,X,Y" with the axes' titles as headers, then one row per point, in the order of the series; a gap is an
/// empty cell. With `isVisibleOnly` only points inside the axes' ranges. Quoting as in RFC 4180, lines end in LF.
std::string figureCsv(const Figure& figure, bool isVisibleOnly);

}  // namespace extremal
