#include "ui/panels/discretizer.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QRegularExpression>
#include <QVBoxLayout>
#include <cmath>

#include "engine/family/elliptic/elliptic.hpp"
#include "engine/family/scheme.hpp"
#include "engine/quadrature/catalog.hpp"
#include "ui/panels/format.hpp"
#include "ui/shell/fitting.hpp"
#include "ui/shell/scheme_edits.hpp"
#include "ui/shell/theme.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {

namespace {

struct SpaceRow {
    const char *id, *heading;
    int degree;
    const char* form = nullptr;  ///< of wave functions, where it is not the usual one
};
Settings spaceOfRow(const SpaceRow& row) {
    Settings space = spaceOf(row.id, row.degree);
    for (auto& [key, value] : space.keys)
        if (row.form && key == "form") value = row.form;
    return space;
}
/// The rows for models with coordinates, for bodies, and for wave functions.
std::vector<SpaceRow> rowsFor(const std::string& space, bool isPeriodic) {
    if (space == "fourier") {
        std::vector<SpaceRow> waves;
        for (const int degree : {1, 2, 3, 4, 6, 8, 12})
            waves.push_back({"fourier", isPeriodic ? "Fourier" : "modes", degree});
        if (isPeriodic) waves.push_back({"fourier", "3-level", 1, "three-level"});
        return waves;
    }
    const bool isLie = space == "lie-polynomial";
    std::vector<SpaceRow> rows;
    for (const int degree : {1, 2, 3, 4, 6, 8})
        rows.push_back(isLie ? SpaceRow{"lie-polynomial", "Lie", degree}
                             : SpaceRow{"polynomial", "poly", degree});
    if (!isLie)
        for (const int degree : {2, 3}) rows.push_back({"spline", "spline", degree});
    return rows;
}

/// "polynomials of degree 3", "splines of degree 3 with 2 cells".
QString spaceText(const Settings& space) {
    const QString degree = QString::number(space.integer("degree"));
    if (space.type == "spline")
        return QObject::tr("splines of degree %1 with %2 cells").arg(degree).arg(space.integer("cells"));
    if (isElliptic(space))
        return (space.text("functions") == "linear" ? QObject::tr("%1 elements with straight lines")
                                                    : QObject::tr("%1 elements that know the coefficient"))
            .arg(space.integer("elements"));
    if (space.text("form") == "three-level")
        return QObject::tr("lines in time over Fourier modes, in three levels");
    if (space.type == "fourier")
        return QObject::tr("polynomials of degree %1 in time over the modes of the model").arg(degree);
    if (space.type == "lie-polynomial")
        return QObject::tr("polynomials of degree %1 in the algebra").arg(degree);
    return QObject::tr("polynomials of degree %1").arg(degree);
}

/// Cells are small: well-known names have well-known abbreviations.
QString abbreviation(const QString& knownAs) {
    if (knownAs.contains("midpoint", Qt::CaseInsensitive)) return QStringLiteral("mid");
    if (knownAs.contains("Verlet", Qt::CaseInsensitive)) return QStringLiteral("SV");
    if (knownAs.contains("trapez", Qt::CaseInsensitive)) return QStringLiteral("trap");
    return {};
}

QString letterOf(const std::string& rule) {
    const RuleEntry* const entry = findRule(rule);
    return entry ? QString::fromStdString(entry->letter) : QString();
}

}  // namespace

DiscretizerCell::DiscretizerCell(Settings space, Settings quadrature, QWidget* parent)
    : QAbstractButton(parent), space_(std::move(space)), quadrature_(std::move(quadrature)) {
    const PairProperties known = describe(space_, quadrature_);
    setEnabled(known.refusal.empty());
    if (isElliptic(space_)) {
        name_ = QString::number(space_.integer("elements"));
        setObjectName("cell." + QString::fromStdString(space_.text("functions")) + "." + name_);
    } else {
        nameByOrder(known);
    }
    const QString ofSpace = spaceText(space_);
    setAccessibleName(ofSpace.at(0).toUpper() + ofSpace.mid(1) +
                      (isElliptic(space_) ? QString() : QStringLiteral(", ") + ruleTitle(quadrature_.type)));
    setToolTip(tooltip(known));
    setAccessibleDescription(toolTip().remove(QRegularExpression("<[^>]*>")));
    setFocusPolicy(Qt::TabFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setCursor(known.refusal.empty() ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void DiscretizerCell::nameByOrder(const PairProperties& known) {
    const QString order = QString::number(known.claims.order);
    name_ = abbreviation(QString::fromStdString(known.knownAs));
    if (name_.isEmpty())
        name_ = letterOf(quadrature_.type) + order;
    else
        order_ = order;
    setObjectName(QString("cell.%1%2.%3")
                      .arg(space_.type == "spline" ? QStringLiteral("spline") : QString())
                      .arg(space_.integer("degree"))
                      .arg(QString::fromStdString(quadrature_.type)));
}

QString DiscretizerCell::tooltip(const PairProperties& known) const {
    const QString pair = spaceText(space_) + QStringLiteral(" × ") + ruleTitle(quadrature_.type);
    if (!known.refusal.empty())
        return tr("<b>%1</b><br>No scheme: %2")
            .arg(pair, QString::fromStdString(known.refusal).toHtmlEscaped());
    if (isElliptic(space_))
        return "<b>" + QString::fromStdString(known.knownAs) + "</b><br>" + spaceText(space_) + "<br>" +
               (known.claims.order > 0
                    ? tr("order %1, once they resolve the coefficient").arg(known.claims.order)
                    : tr("exact at the nodes, however few")) +
               "<br><i>" + tr("Click to add it to the comparison.") + "</i>";
    QString text = "<b>" +
                   (known.knownAs.empty() ? pair : QString::fromStdString(known.knownAs).toHtmlEscaped()) +
                   "</b>";
    if (!known.knownAs.empty()) text += "<br>" + pair;
    QStringList badges{tr("order %1").arg(known.claims.order)};
    badges << tr("order %1 between the nodes").arg(known.curveOrder);
    if (known.claims.isSymplectic) badges << tr("symplectic");
    if (known.claims.isSymmetric) badges << tr("symmetric");
    badges << (known.isExplicit ? tr("explicit where the model is separable") : tr("implicit"));
    text += "<br>" + badges.join(" · ");
    if (!known.shortfall.empty()) text += "<br>" + QString::fromStdString(known.shortfall).toHtmlEscaped();
    if (!known.claims.conserves.empty()) {
        QStringList kept;
        for (const std::string& c : known.claims.conserves) kept << QString::fromStdString(c);
        text += "<br>" + tr("conserves %1").arg(kept.join(", "));
    }
    if (std::isinf(known.stabilityLimit))
        text += "<br>" + tr("stable at every step on the harmonic oscillator");
    else if (known.stabilityLimit > 0)
        text += "<br>" + tr("stable on the harmonic oscillator for h ω below %1")
                             .arg(shortNumber(known.stabilityLimit, 3));
    return text + "<br><i>" + tr("Click to add it to the comparison.") + "</i>";
}

void DiscretizerCell::setTheme(const Theme& theme) {
    theme_ = &theme;
    update();
}

void DiscretizerCell::setPresent(bool isPresent) {
    if (isPresent_ == isPresent) return;
    isPresent_ = isPresent;
    update();
}

void DiscretizerCell::paintEvent(QPaintEvent*) {
    if (!theme_) return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    QColor ground = isPresent_ ? theme_->accent : theme_->field;
    if (!isEnabled()) ground = Qt::transparent;
    if (isEnabled() && underMouse() && !isPresent_) ground = theme_->selection;
    painter.setPen(hasFocus() ? QPen(theme_->accent, 1) : QPen(Qt::NoPen));
    painter.setBrush(ground);
    painter.drawRoundedRect(box, 4, 4);
    if (!isEnabled()) {
        painter.setPen(QPen(theme_->line, 1));
        painter.drawLine(QPointF(box.center().x() - 3, box.center().y()),
                         QPointF(box.center().x() + 3, box.center().y()));
        return;
    }
    QFont font = theme_->strong();
    font.setPixelSize(font.pixelSize() - 1);
    QFont small = theme_->caption();
    small.setPixelSize(small.pixelSize() - 3);
    const QFontMetricsF metrics(font), smallMetrics(small);
    const double orderWidth = order_.isEmpty() ? 0 : smallMetrics.horizontalAdvance(order_) + 1;
    const double left = (width() - metrics.horizontalAdvance(name_) - orderWidth) / 2;
    const double baseline = (height() + metrics.capHeight()) / 2;
    painter.setPen(isPresent_ ? theme_->onAccent : theme_->text);
    painter.setFont(font);
    painter.drawText(QPointF(left, baseline), name_);
    painter.setFont(small);
    painter.drawText(QPointF(left + metrics.horizontalAdvance(name_) + 1, baseline - 4), order_);
}

Discretizer::Discretizer(Workspace& workspace, QWidget* parent)
    : Card(tr("Discretizer"), parent), workspace_(workspace) {
    setSubtitle(tr("space × quadrature"));
    fill("polynomial", true);
    connect(&workspace_, &Workspace::sceneChanged, this, &Discretizer::refresh);
}

/// One row per degree of the space, one column per rule.
void Discretizer::fill(const std::string& space, bool isPeriodic) {
    space_ = space;
    isPeriodic_ = isPeriodic;
    cells_.clear();
    delete grid_;
    grid_ = new QWidget;
    auto* grid = new QGridLayout(grid_);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(3);
    grid->setVerticalSpacing(3);
    body()->addWidget(grid_);
    const bool isOfElements = isElliptic({space, {}, {}});
    setSubtitle(isOfElements ? tr("functions × elements") : tr("space × quadrature"));
    if (isOfElements) return fillElements(*grid);
    const std::vector<SpaceRow> rows = rowsFor(space, isPeriodic);
    int column = 1;
    for (const RuleEntry* rule : rulesByPlace()) {
        if (rule->heading.empty()) continue;
        const std::string& id = rule->item.id;
        QLabel* heading = makeLabel(QString::fromStdString(rule->heading), "caption");
        heading->setAlignment(Qt::AlignHCenter);
        heading->setToolTip(ruleTitle(id));
        grid->addWidget(heading, 0, column);
        grid->setColumnStretch(column, 1);
        int row = 1;
        for (const SpaceRow& line : rows) {
            const Settings ofRow = spaceOfRow(line);
            addCell(*grid, ofRow, ruleFor(id, ofRow), row++, column);
        }
        ++column;
    }
    int row = 1;
    for (const SpaceRow& line : rows) {
        QLabel* name = makeLabel(QString("%1 %2").arg(line.heading).arg(line.degree), "caption");
        name->setToolTip(tr("On each step: %1").arg(spaceText(spaceOfRow(line))));
        grid->addWidget(name, row++, 0);
    }
}

void Discretizer::addCell(QGridLayout& grid, const Settings& space, const Settings& rule, int row,
                          int column) {
    auto* cell = new DiscretizerCell(space, rule);
    if (theme_) cell->setTheme(*theme_);
    connect(cell, &QAbstractButton::clicked, this, [this, cell] { choose(*cell); });
    cells_.push_back(cell);
    grid.addWidget(cell, row, column);
}

/// The elliptic problem has no rule to choose: its elements take theirs from the coefficient.
void Discretizer::fillElements(QGridLayout& grid) {
    int row = 0;
    for (const char* functions : {"multiscale", "linear"}) {
        grid.addWidget(makeLabel(QString::fromUtf8(functions), "caption"), row, 0);
        int column = 1;
        for (const int elements : {5, 10, 20, 40, 80, 160}) {
            const Settings space{
                space_, {{"functions", functions}, {"elements", static_cast<double>(elements)}}, {}};
            grid.setColumnStretch(column, 1);
            addCell(grid, space, ruleFor("auto", space), row, column++);
        }
        ++row;
    }
}

void Discretizer::setTheme(const Theme& theme) {
    theme_ = &theme;
    for (DiscretizerCell* cell : cells_) cell->setTheme(theme);
}

DiscretizerCell* Discretizer::cell(int degree, const QString& rule) const {
    return findChild<DiscretizerCell*>(QString("cell.%1.%2").arg(degree).arg(rule));
}

void Discretizer::refresh() {
    const bool isPeriodic = workspace_.scene().model.text("boundary") != "dirichlet";
    if (const std::string space = pairSpace(workspace_.scene()); space != space_ || isPeriodic != isPeriodic_)
        fill(space, isPeriodic);
    for (DiscretizerCell* cell : cells_)
        cell->setPresent(findPair(workspace_.scene(), cell->space(), cell->quadrature()) >= 0);
}

void Discretizer::choose(const DiscretizerCell& cell) {
    const Scene& scene = workspace_.scene();
    if (const int there = findPair(scene, cell.space(), cell.quadrature()); there >= 0)
        return workspace_.selectScheme(there);
    const Value scheme = newPair(scene, cell.space(), cell.quadrature());
    const QString label = QString::fromStdString(scheme.find("label")->asString());
    if (workspace_.edit(editsForAdding(scheme), tr("Add %1").arg(label)))
        workspace_.selectScheme(static_cast<int>(workspace_.scene().schemes.size()) - 1);
}

}  // namespace extremal
