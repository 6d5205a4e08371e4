// SPDX-License-Identifier: GPL-3.0-or-later
/// How much two pictures differ: for `extremal snapshot --compare`, and for tests that compare with a golden
/// image.
///
///     differing(A) = 100 (pixels of A with max over channels |a - b| > threshold) / (pixels of A) [percent]
///
/// for the whole picture, and for the worst of its tiles of 16 x 16 pixels, which overlap by half: a missing
/// mark is a negligible part of the picture, but not of its tile.
#pragma once

#include <QImage>
#include <QRect>

namespace extremal {

struct ImageDifference {
    bool hasSameSize = false;
    double differingPercent = 100;  ///< of the whole picture
    double worstTilePercent = 100;  ///< of the tile where it is largest
    QRect worstTile;                ///< that tile; empty if nothing differs
    int largest = 255;              ///< largest difference of one channel
    QImage picture;  ///< the first picture, faint, with differing pixels in red; empty if sizes differ
};

/// `threshold` is the difference of a channel (0..255) that still counts as equal.
ImageDifference compareImages(const QImage& actual, const QImage& expected, int threshold = 8);

/// Actual, expected and difference beside each other, with captions.
QImage sideBySide(const QImage& actual, const QImage& expected, const ImageDifference& difference);

}  // namespace extremal
