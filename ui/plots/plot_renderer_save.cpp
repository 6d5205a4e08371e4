// SPDX-License-Identifier: GPL-3.0-or-later
/// Pages as PNG, PDF and SVG files, the same bytes every time.
#include "ui/plots/plot_renderer.hpp"

#include <QBuffer>
#include <QFileInfo>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QSvgGenerator>

#include <cmath>

#include "engine/core/text/markup.hpp"
#include "engine/run/files/replacing.hpp"

namespace extremal {
namespace {

QByteArray pngBytes(QSize size, double scale, const DrawPage& draw) {
    QImage image(QSize(static_cast<int>(std::lround(size.width() * scale)),
                       static_cast<int>(std::lround(size.height() * scale))),
                 QImage::Format_RGB32);
    image.fill(Qt::white);
    image.setDotsPerMeterX(static_cast<int>(std::lround(96 * scale / 0.0254)));
    image.setDotsPerMeterY(image.dotsPerMeterX());
    {
        FigurePainter painter(image, false);
        painter.painter().scale(scale, scale);
        draw(painter, QRectF(QPointF(0, 0), QSizeF(size)));
    }
    image.setText(QStringLiteral("Software"), QString::fromLatin1(maker));
    QBuffer buffer;
    image.save(&buffer, "PNG");
    return buffer.data();
}

QByteArray pdfBytes(QSize size, const QString& title, const DrawPage& draw) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    {
        constexpr int finer = 10;  // positions of letters are whole units of the device
        QPdfWriter writer(&buffer);
        writer.setTitle(title);
        writer.setCreator(QString::fromLatin1(maker));
        writer.setResolution(96 * finer);
        writer.setPageSize(
            QPageSize(QSizeF(size) * 72.0 / 96.0, QPageSize::Point, {}, QPageSize::ExactMatch));
        writer.setPageMargins(QMarginsF(0, 0, 0, 0));
        FigurePainter painter(writer, true);
        painter.painter().scale(finer, finer);
        draw(painter, QRectF(QPointF(0, 0), QSizeF(size)));
    }
    // The only bytes that change from run to run say when; a fixed time of the same length keeps all offsets.
    QByteArray bytes = buffer.data();
    static const QByteArray key("/CreationDate (");
    if (const qsizetype at = bytes.indexOf(key); at >= 0) {
        const qsizetype from = at + key.size(), to = bytes.indexOf(')', from);
        const QByteArray epoch = QByteArray("D:19700101000000Z").leftJustified(to - from, ' ', true);
        bytes.replace(from, to - from, epoch);
    }
    return bytes;
}

QByteArray svgBytes(QSize size, const QString& title, const DrawPage& draw) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    {
        QSvgGenerator generator;
        generator.setOutputDevice(&buffer);
        generator.setResolution(96);
        generator.setSize(size);
        generator.setViewBox(QRect(QPoint(0, 0), size));
        generator.setTitle(QStringLiteral("-"));  // Qt writes it as it is: ours comes later, escaped
        generator.setDescription(QStringLiteral("made by Extremal"));
        FigurePainter painter(generator, true);
        draw(painter, QRectF(QPointF(0, 0), QSizeF(size)));
    }
    QByteArray bytes = buffer.data();
    bytes.replace("<title>-</title>",
                  "<title>" + QByteArray::fromStdString(markupText(title.toStdString())) + "</title>");
    // What Qt draws it escapes, but for the characters that XML does not have.
    for (char& c : bytes)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r') c = ' ';
    for (const char* noncharacter : {"\xef\xbf\xbe", "\xef\xbf\xbf"})
        bytes.replace(noncharacter, "\xef\xbf\xbd");
    // Readers without the font shall not fall back to one with serifs.
    bytes.replace("font-family=\"Inter\"", "font-family=\"Inter, Helvetica, Arial, sans-serif\"");
    // Behind the declaration of XML.
    return QByteArray::fromStdString(markedAsOwn(bytes.toStdString(), "<!-- ", " -->", 1));
}

}  // namespace

QString savePage(const QString& file, QSize size, double scale, const QString& title, const DrawPage& draw) {
    const QString kind = QFileInfo(file).suffix().toLower();
    QByteArray bytes;
    if (kind == QLatin1String("png"))
        bytes = pngBytes(size, scale, draw);
    else if (kind == QLatin1String("pdf"))
        bytes = pdfBytes(size, title, draw);
    else if (kind == QLatin1String("svg"))
        bytes = svgBytes(size, title, draw);
    else
        return QStringLiteral("%1: pictures are written as .png, .pdf or .svg, got \".%2\"").arg(file, kind);
    QSaveFile target(file);
    if (!target.open(QIODevice::WriteOnly) || target.write(bytes) != bytes.size() || !target.commit())
        return QStringLiteral("%1: %2").arg(file, target.errorString());
    return {};
}

}  // namespace extremal
