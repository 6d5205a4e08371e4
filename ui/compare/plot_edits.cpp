// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/plot_edits.hpp"

#include <QActionGroup>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFontDatabase>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPointer>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/figure/figure.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"
#include "ui/base/card.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

std::vector<const ViewEntry*> offeredPlots(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<const ViewEntry*> offered;
    for (const ViewEntry& entry : viewEntries()) {
        const std::string& id = entry.item.id;
        if (!entry.isPlot() || id == "work-precision" || !missingFor({id, "", ""}, system).empty()) continue;
        const bool isShowable =
            std::any_of(scene.schemes.begin(), scene.schemes.end(),
                        [&](const SchemeSpec& s) { return unsuitableFor(entry, resolve(s)).empty(); });
        if (isShowable && (id != mapView || canBeMapped(scene, system))) offered.push_back(&entry);
    }
    return offered;
}

std::vector<View> viewsForPlot(const Scene& scene, const View& before, const View& after) {
    std::vector<View> views;
    bool isThere = false;
    for (const View& view : scene.views.empty() ? plotViews(scene) : scene.views) {
        Scene alone = scene;
        alone.views = {view};
        std::vector<View> plots = plotViews(alone);
        const auto found = std::find(plots.begin(), plots.end(), before);
        if (isThere || found == plots.end()) {
            views.push_back(view);
            continue;
        }
        isThere = true;
        *found = after;
        views.insert(views.end(), plots.begin(), plots.end());
    }
    if (!isThere) views.push_back(after);  // one that is always shown
    return views;
}

std::vector<Edit> editsForViews(const Scene& scene, std::vector<View> views) {
    Scene changed = scene;
    changed.views = std::move(views);
    return {{"/views", *toValue(changed).find("views")}};
}

std::vector<Edit> editsForSeen(const Scene& scene) {
    const Value value = toValue(scene);
    const Value* const shown = value.find("show");
    return {{"/views", *value.find("views")}, {"/show", shown ? std::optional(*shown) : std::nullopt}};
}

std::vector<Edit> editsForPlot(const Scene& scene, const View& before, const View& after) {
    return editsForViews(scene, viewsForPlot(scene, before, after));
}

namespace {

/// Every view alone: one of the scene can stand for several plots. "stage" and speed against accuracy stay.
std::vector<View> singleViews(const Scene& scene) {
    std::vector<View> all;
    for (const View& view : scene.views.empty() ? plotViews(scene) : scene.views) {
        Scene alone = scene;
        alone.views = {view};
        std::vector<View> plots = plotViews(alone);
        if (plots.empty() || view.id == "stage") plots = {view};
        all.insert(all.end(), plots.begin(), plots.end());
    }
    return all;
}

}  // namespace

std::vector<Edit> editsWithoutPlot(const Scene& scene, const View& view) {
    std::vector<View> views = singleViews(scene);
    const auto at = std::find(views.begin(), views.end(), view);
    if (at == views.end()) return {};
    views.erase(at);
    return editsForViews(scene, std::move(views));
}

std::vector<Edit> editsForMovedPlot(const Scene& scene, const View& view, int by) {
    std::vector<View> views = singleViews(scene);
    const auto isPlot = [](const View& v) { return v.id != "stage" && v.id != "work-precision"; };
    std::vector<std::size_t> plots;  // their places
    std::size_t now = views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!isPlot(views[i])) continue;
        if (views[i] == view) now = plots.size();
        plots.push_back(i);
    }
    const auto to = static_cast<std::ptrdiff_t>(now) + by;
    if (now >= plots.size() || to < 0 || to >= static_cast<std::ptrdiff_t>(plots.size())) return {};
    std::swap(views[plots[now]], views[plots[static_cast<std::size_t>(to)]]);
    return editsForViews(scene, std::move(views));
}

ViewRange roundedRange(PlotRange range, bool isLog) {
    const auto rounded = [&](double value) {
        const double size = isLog ? value : range.high - range.low;
        const double unit = std::pow(10, std::floor(std::log10(size)) - (isLog ? 3 : 4));
        // Through a whole number of an inverse power: the nearest double to the decimal number, so that it is
        // saved as that.
        return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
    };
    return {{rounded(range.low), {}}, {rounded(range.high), {}}};
}

View withPart(const View& view, const PlotWidget& plot) {
    View after = view;
    if (plot.isUserZoomed(PlotAxis::x))
        after.xRange = roundedRange(plot.visibleRange(PlotAxis::x), plot.figure().x.isLog);
    if (plot.isUserZoomed(PlotAxis::y))
        after.yRange = roundedRange(plot.visibleRange(PlotAxis::y), plot.figure().y.isLog);
    return after;
}

namespace {

using ViewSource = std::function<View()>;

/// Entries of a menu of which one is chosen; choosing another changes the view, and takes away the part that
/// was kept and a curve whose variable goes.
class Choices {
public:
    Choices(QMenu& menu, Workspace& workspace, ViewSource view)
        : menu_(menu), group_(new QActionGroup(&menu)), workspace_(workspace), view_(std::move(view)) {}

    template <class Change>
    void add(const QString& text, bool isChosen, Change change) {
        QAction* action = menu_.addAction(text);
        action->setCheckable(true);
        action->setChecked(isChosen);
        group_->addAction(action);
        const auto choose = [&workspace = workspace_, view = view_, change] {
            const View before = view();
            View after = before;
            change(after);
            const System& system = *workspace.resolved()->system;
            if (axesOf(before, system).variable != axesOf(after, system).variable) after.curve = {};
            workspace.edit(editsForPlot(workspace.scene(), before, after),
                           QObject::tr("Change the contents of a plot"));
        };
        // After the menu has closed: the card is created again, and its menu with it.
        QObject::connect(action, &QAction::triggered, &workspace_,
                         [&workspace = workspace_, choose] { QTimer::singleShot(0, &workspace, choose); });
    }

private:
    QMenu& menu_;
    QActionGroup* group_;
    Workspace& workspace_;
    ViewSource view_;
};

void fillNames(QMenu& menu, Workspace& workspace, const std::vector<std::string>& names,
               std::string View::*member, const QString& none, const ViewSource& view) {
    menu.clear();
    Choices choices(menu, workspace, view);
    const std::string now = view().*member;
    const auto add = [&](const QString& text, const std::string& name) {
        choices.add(text, name == now, [member, name](View& after) {
            after.*member = name;
            if (member == &View::scheme) return;
            after.xRange = after.yRange = {};
            after.curve = {};
        });
    };
    add(none, "");
    for (const std::string& name : names) add(QString::fromStdString(name).replace('&', "&&"), name);
}

}  // namespace

void addChoices(QMenu& menu, Workspace& workspace, const std::string& id, const ViewSource& view) {
    const ViewEntry* entry = findView(id);
    if (!entry) return;
    for (const FieldInfo& field : entry->item.parameters) {
        if (field.type != FieldType::choice) continue;
        QString title = QString::fromStdString(field.title);
        title[0] = title[0].toUpper();
        QMenu* sub = menu.addMenu(title);
        sub->setToolTip(QString::fromStdString(field.description));
        Choices choices(*sub, workspace, view);
        const std::string given = view().keys.text(field.key),
                          now = given.empty() ? field.choices.front() : given;
        for (const std::string& choice : field.choices)
            choices.add(
                QString::fromStdString(choice), choice == now, [key = field.key, choice](View& after) {
                    std::erase_if(after.keys.keys, [&](const Value::Member& m) { return m.first == key; });
                    after.keys.keys.emplace_back(key, choice);
                    after.xRange = after.yRange = {};
                });
    }
}

void addNames(QMenu& menu, Workspace& workspace, const std::string& id, const ViewSource& view) {
    const System& system = *workspace.resolved()->system;
    const ViewKeys keys = keysOf(id, &system);
    const QString usual = QObject::tr("default");
    using Names = std::function<std::vector<std::string>(const Scene&)>;
    const auto add = [&](const QString& title, std::string View::*member, const QString& none,
                         const Names& names) {
        QMenu* sub = menu.addMenu(title);
        QObject::connect(sub, &QMenu::aboutToShow, &workspace, [sub, &workspace, view, member, none, names] {
            fillNames(*sub, workspace, names(workspace.scene()), member, none, view);
        });
    };
    const Names columns = [id](const Scene& scene) { return columnsFor(id, scene, makeSystem(scene)); };
    if (keys.hasColumns) {
        add(QObject::tr("Along x"), &View::x, usual, columns);
        add(QObject::tr("Along y"), &View::y, usual, columns);
    }
    if (keys.hasZeros)
        add(QObject::tr("Section at"), &View::at, usual,
            [](const Scene& scene) { return zerosFor(makeSystem(scene)); });
    if (keys.hasScheme) add(QObject::tr("Scheme"), &View::scheme, QObject::tr("the first"), labelsOf);
    if (keys.hasNode)
        menu.addAction(QObject::tr("Node..."), &menu, [&workspace, view, &menu] {
            const QPointer<QMenu> guard(&menu);  // its plot may leave the page meanwhile
            const View before = view();
            const int last = lastNodeOf(workspace.scene());
            bool isChosen = false;
            const int node = QInputDialog::getInt(
                menu.parentWidget(), QObject::tr("Node"),
                QObject::tr("Node, 1 to %1 from left to right").arg(last),
                before.node ? static_cast<int>(before.node->value) : (last + 1) / 2, 1, last, 1, &isChosen);
            if (!isChosen || !guard) return;
            View after = before;
            after.node = Number{static_cast<double>(node), {}};
            workspace.edit(editsForPlot(workspace.scene(), before, after),
                           QObject::tr("Change the contents of a plot"));
        });
}

void askForCurve(Workspace& workspace, const View& of, QWidget* parent) {
    const View view = of;  // the plot may leave the page meanwhile
    QDialog dialog(parent);
    dialog.setWindowTitle(QObject::tr("Compare with a curve"));
    dialog.setMinimumWidth(440);
    auto* layout = new QVBoxLayout(&dialog);
    const QString variable = QString::fromStdString(axesOf(view, *workspace.resolved()->system).variable);
    layout->addWidget(makeLabel(
        QObject::tr("An expression in %1 and the model's parameters; empty: no curve.").arg(variable),
        "caption"));
    auto* input = new QLineEdit(QString::fromStdString(view.curve.expression));
    input->setAccessibleName(QObject::tr("Curve"));
    input->setPlaceholderText(QStringLiteral("0.5*cos(2*pi*%1)").arg(variable));
    auto* problem = new QLabel;
    problem->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    problem->setTextFormat(Qt::PlainText);
    problem->hide();
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    layout->addWidget(input);
    layout->addWidget(problem);
    layout->addWidget(buttons);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, [&] {
        View after = view;
        after.curve = {input->text().trimmed().toStdString(), {}};
        const std::vector<Problem> problems = workspace.tryEdit(editsForPlot(workspace.scene(), view, after),
                                                                QObject::tr("Compare with a curve"));
        if (problems.empty()) return dialog.accept();
        problem->setText(QString::fromStdString(problems.front().message));
        problem->show();
    });
    dialog.exec();
}

}  // namespace extremal
