/// How much two pictures differ: for `extremal snapshot --compare` and for tests that compare with a kept
/// picture.
///
///     differing = 100 (pixels with max over channels |a - b| > threshold) / pixels            [percent]
///     SSIM      = mean over 8 x 8 windows, every 4 pixels, of
///                 (2 mx my + c1)(2 sxy + c2) / ((mx^2 + my^2 + c1)(sx^2 + sy^2 + c2))
/// on the luminance 0..255, with c1 = (0.01 * 255)^2 and c2 = (0.03 * 255)^2 (Wang, Bovik, Sheikh, Simoncelli
/// 2004, with a square window instead of a Gaussian one).
#pragma once

#include <QImage>

namespace extremal {

struct ImageDifference {
    bool hasSameSize = false;
    double differingPercent = 100;  ///< pixels beyond the threshold
    int largest = 255;              ///< largest difference of one channel
    double ssim = 0;                ///< 1: the same
    QImage picture;  ///< the first picture, faint, with differing pixels in red; empty if sizes differ
};

/// `threshold` is the difference of a channel (0..255) that is still taken as equal.
ImageDifference compareImages(const QImage& actual, const QImage& expected, int threshold = 8);

/// Actual, expected and difference beside each other, with captions.
QImage sideBySide(const QImage& actual, const QImage& expected, const ImageDifference& difference);

}  // namespace extremal
