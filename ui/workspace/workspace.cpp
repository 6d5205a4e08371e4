// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/workspace.hpp"

#include <QCoreApplication>
#include <QEvent>
#include <QEventLoop>
#include <QFileInfo>
#include <QSaveFile>
#include <QThread>

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "engine/scene/outlook/topics.hpp"
#include "engine/scene/own_folder.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/base/background.hpp"
#include "ui/base/notices.hpp"
#include "ui/workspace/disk_file.hpp"

namespace extremal {

namespace {

bool isAtOrBelow(std::string_view pointer, std::string_view place) {
    return pointer.starts_with(place) && (pointer.size() == place.size() || pointer[place.size()] == '/');
}

/// The scene with every default filled in, and the steps of the lesson, which a Scene does not hold.
Value completed(const Scene& scene, const Value& document) {
    Value value = toValue(scene);
    if (const Value* steps = document.find("steps")) value.set("steps", *steps);
    return value;
}

std::string directoryOf(const QString& path) {
    return path.isEmpty() ? "." : QFileInfo(path).absolutePath().toStdString();
}

/// While there is one, timers and messages from threads wait: what they set going could remove the field or
/// the cell whose edit is being checked. A timer whose event is dropped fires again.
class PaintingOnly : public QObject {
public:
    PaintingOnly() { qApp->installEventFilter(this); }
    bool eventFilter(QObject*, QEvent* event) override { return event->type() == QEvent::Timer; }

private:
    HeldMessages held_;
};

/// Reads a scene in a thread of its own, as tables in quadruple precision and forecasts take up to a few
/// hundred milliseconds, and checks of free knots seconds. Where it is not read within a moment the window
/// goes on painting; what the user does waits.
ReadScene readAside(std::function<ReadScene()> read) {
    using namespace std::chrono_literals;
    std::packaged_task<ReadScene()> task(std::move(read));
    std::future<ReadScene> result = task.get_future();
    const std::unique_ptr<QThread> thread(QThread::create(std::move(task)));
    QEventLoop loop;
    QObject::connect(thread.get(), &QThread::finished, &loop, &QEventLoop::quit);
    thread->start();
    if (result.wait_for(20ms) != std::future_status::ready) {
        const PaintingOnly painting;
        loop.exec(QEventLoop::ExcludeUserInputEvents);
    }
    thread->wait();
    return result.get();
}

}  // namespace

Workspace::Workspace(Notices& notices, QObject* parent)
    : QObject(parent), notices_(notices), disk_(new DiskFile(this)) {
    connect(disk_, &DiskFile::changed, this,
            [this] { tellOfChange(tr("%1 was changed by another program or window").arg(fileName())); });
    connect(disk_, &DiskFile::restored, this, [this] { notices_.dismiss("disk"); });
}

/// Makes the edits of the document, or of another one in its place; else problems_ says why not.
bool Workspace::accept(const std::vector<Edit>& edits, const Value* instead) {
    Value candidate;
    ReadScene read;
    int revision = 0;
    do {  // a field that loses the focus while the scene is read makes an edit of its own, which must stay
        revision = revision_;
        candidate = withEdits(instead ? *instead : document_, edits);
        read = readAside([&] { return readScene(candidate, {}, directoryOf(path_)); });
    } while (revision != revision_);
    problems_ = read.errors;
    if (!problems_.empty()) return false;
    Value complete = completed(read.scene, candidate);
    setDocument(std::move(complete), std::move(read));
    return true;
}

/// What was typed before and refused at places that the edits leave alone.
std::vector<Edit> Workspace::draftsBeside(const std::vector<Edit>& edits) const {
    std::vector<Edit> beside;
    for (const auto& [pointer, value] : drafts_)
        if (std::none_of(edits.begin(), edits.end(),
                         [&place = pointer](const Edit& e) { return isAtOrBelow(place, e.pointer); }))
            beside.push_back({pointer, value});
    return beside;
}

void Workspace::announce() {
    emit draftsChanged();
    emit sceneChanged();
    emit fileChanged();
}

std::optional<Workspace::Refusal> Workspace::attempt(const std::vector<Edit>& edits, const QString& what,
                                                     const QString& mergeKey) {
    const EditState before = state();
    std::vector<Edit> all = draftsBeside(edits);
    const bool hasOtherDrafts = !all.empty();
    all.insert(all.end(), edits.begin(), edits.end());
    if (accept(all)) {
        drafts_.clear();
    } else {
        Refusal refusal{problems_, problems_};
        if (!hasOtherDrafts) return refusal;
        const bool isAccepted = accept(edits);
        refusal.alone = std::exchange(problems_, refusal.together);
        if (!isAccepted) return refusal;
        for (const Edit& e : edits)
            std::erase_if(drafts_, [&](const auto& d) { return isAtOrBelow(d.first, e.pointer); });
    }
    if (!(before == state())) history_.push(before, what, mergeKey);
    notices_.dismiss("refused");
    announce();
    return {};
}

bool Workspace::edit(const std::vector<Edit>& edits, const QString& what, const QString& mergeKey) {
    if (!hasScene()) return false;
    const EditState before = state();
    const std::vector<Problem> problemsBefore = problems_;
    const std::optional<Refusal> refusal = attempt(edits, what, mergeKey);
    if (!refusal) return true;
    for (const Problem& p : refusal->alone)
        notices_.addToLog(
            tr("%1 was refused: %2: %3").arg(what, placeName(p.pointer), QString::fromStdString(p.message)));
    problems_ = refusal->together;
    for (const Edit& e : edits) {
        if (e.value) drafts_[e.pointer] = *e.value;
        unclaimed_.push_back(e.pointer);
    }
    emit draftsChanged();
    if (unclaimed_.empty()) {
        if (!(before == state())) history_.push(before, what, mergeKey);
        return false;
    }
    unclaimed_.clear();
    drafts_ = before.drafts;
    problems_ = problemsBefore;
    emit draftsChanged();
    post(what, refusal->alone);
    return false;
}

std::vector<Problem> Workspace::tryEdit(const std::vector<Edit>& edits, const QString& what) {
    if (!hasScene()) return {{{}, "there is no scene", {}}};
    const std::vector<Problem> problemsBefore = problems_;
    const std::optional<Refusal> refusal = attempt(edits, what, {});
    if (!refusal) return {};
    problems_ = problemsBefore;
    return refusal->alone;
}

void Workspace::post(const QString& what, const std::vector<Problem>& problems) {
    const Problem& first = problems.front();
    const QString where = placeName(first.pointer);
    QString text = QString::fromStdString(first.message);
    if (!where.isEmpty()) text = where + ": " + text;
    if (problems.size() > 1) text += tr(", and %n more", nullptr, static_cast<int>(problems.size()) - 1);
    notices_.post({Notice::Kind::warning,
                   "refused",
                   tr("%1 was refused. %2").arg(what, text),
                   QString::fromStdString(first.hint),
                   {},
                   handbookPlace(first)});
}

QString Workspace::placeName(const std::string& pointer) const {
    const auto tokens = splitPointer(pointer);
    const auto index = tokens && tokens->size() > 1 && tokens->front() == "schemes" ? arrayIndex((*tokens)[1])
                                                                                    : std::nullopt;
    if (!index || *index >= scene_.schemes.size()) return QString::fromStdString(pointer);
    QStringList words;
    for (std::size_t i = 2; i < tokens->size(); ++i) words << QString::fromStdString((*tokens)[i]);
    const QString label = QString::fromStdString(scene_.schemes[*index].label);
    return words.isEmpty() ? label : label + ", " + words.join(' ');
}

const Value* Workspace::draftAt(const std::string& pointer) const {
    for (const auto& [place, value] : drafts_) {
        if (!isAtOrBelow(pointer, place)) continue;
        const Value* const typed = valueAt(value, std::string_view(pointer).substr(place.size()));
        const Value* const now = valueAt(document_, pointer);
        if (typed && !(now && *now == *typed)) return typed;
    }
    return nullptr;
}

std::vector<Problem> Workspace::refusalAt(const std::string& pointer) const {
    const bool isRefused =
        draftAt(pointer) || std::any_of(drafts_.begin(), drafts_.end(),
                                        [&](const auto& d) { return isAtOrBelow(d.first, pointer); });
    if (!isRefused) return {};
    std::vector<Problem> here, elsewhere;
    for (const Problem& p : problems_) {
        if (isAtOrBelow(p.pointer, pointer)) here.push_back(p);
        const bool isOfOther = std::any_of(drafts_.begin(), drafts_.end(), [&](const auto& d) {
            return isAtOrBelow(p.pointer, d.first) && !isAtOrBelow(pointer, d.first) &&
                   !isAtOrBelow(d.first, pointer);
        });
        if (!isOfOther) elsewhere.push_back(p);
    }
    return !here.empty() ? here : !elsewhere.empty() ? elsewhere : problems_;
}

void Workspace::claimRefusal(const std::string& pointer) {
    if (std::any_of(unclaimed_.begin(), unclaimed_.end(), [&](const std::string& place) {
            return isAtOrBelow(place, pointer) || isAtOrBelow(pointer, place);
        }))
        unclaimed_.clear();
}

void Workspace::dropDraft(const std::string& pointer) {
    const EditState before = state();
    if (!drafts_.erase(pointer)) return;
    problems_.clear();
    if (drafts_.empty() || !accept(draftsBeside({}))) return emit draftsChanged();
    drafts_.clear();
    history_.push(before, tr("Change what was refused"), {});
    announce();
}

void Workspace::setDocument(Value document, ReadScene read) {
    document_ = std::move(document);
    scene_ = std::move(read.scene);
    resolved_ = std::move(read.resolved);
    warnings_ = std::move(read.warnings);
    ++revision_;
    if (selected_ >= static_cast<int>(scene_.schemes.size()))
        selectScheme(static_cast<int>(scene_.schemes.size()) - 1);
}

void Workspace::restore(const EditState& state) {
    drafts_.clear();
    accept({}, &state.document);
    notices_.dismiss("refused");
    if (!state.drafts.empty()) {
        drafts_ = state.drafts;
        std::vector<Edit> refused;
        for (const auto& [pointer, value] : drafts_) refused.push_back({pointer, value});
        const Value document = withEdits(document_, refused);
        problems_ = readAside([&] { return readScene(document, {}, directoryOf(path_)); }).errors;
    }
    announce();
}

void Workspace::undo() {
    if (history_.canUndo()) restore(history_.undo(state()));
}

void Workspace::redo() {
    if (history_.canRedo()) restore(history_.redo(state()));
}

void Workspace::report(const QString& name, const std::vector<Problem>& problems) {
    openProblems_ = problems;
    QStringList lines, hints;
    for (const Problem& p : problems) {
        const QString where = p.pointer.empty() ? QString() : QString::fromStdString(p.pointer) + ": ";
        if (lines.size() < 3) lines << where + QString::fromStdString(p.message);
        if (!p.hint.empty() && hints.isEmpty()) hints << QString::fromStdString(p.hint);
        notices_.addToLog(name + ": " + where + QString::fromStdString(p.message));
    }
    std::vector<Notice::Choice> choices;
    if (problems.size() > 3) {
        lines << tr("and %1 more, which are in the log").arg(problems.size() - 3);
        choices.push_back({tr("Show the log"), [this] { emit notices_.logRequested(); }});
    }
    notices_.post({Notice::Kind::error, "open", tr("%1 cannot be used: %2").arg(name, lines.join("; ")),
                   hints.join("; "), std::move(choices),
                   problems.empty() ? std::string() : handbookPlace(problems.front())});
}

bool Workspace::open(const QString& name, bool isTrusted) {
    std::string text;
    try {
        text = loadSceneText(name.toStdString());
    } catch (const InvalidScene& error) {
        report(name, error.problems());
        return false;
    }
    const bool isPreset = name.startsWith("preset:");
    const QString path = isPreset || name == "-" ? QString() : QFileInfo(name).absoluteFilePath();
    ReadScene read = readAside([&] { return readScene(std::string_view(text), {}, directoryOf(path)); });
    if (!read.errors.empty()) {
        report(isPreset ? name : QFileInfo(name).fileName(), read.errors);
        return false;
    }
    if (const std::string file = fileOutside(read.scene, directoryOf(path)); !isTrusted && !file.empty()) {
        notices_.post({Notice::Kind::warning,
                       "open",
                       tr("%1 wants to read a file outside its folder: %2")
                           .arg(QFileInfo(name).fileName(), QString::fromStdString(file)),
                       tr("read it only if you trust who made the scene"),
                       {{tr("Read it"), [this, name] { emit agreedToRead(name); }}},
                       "security"});
        return false;
    }
    notices_.dismiss("open");
    notices_.dismiss("refused");
    path_ = path;
    origin_ = isPreset ? name : path;
    disk_->take(path_, text);
    notices_.dismiss("disk");
    notices_.dismiss("save");
    drafts_.clear();
    problems_.clear();
    history_.clear();
    Value document = completed(read.scene, parseJson(text));
    saved_ = document;
    setDocument(std::move(document), std::move(read));
    selectScheme(-1);
    emit opened();
    announce();
    return true;
}

bool Workspace::adopt(const Value& document, const QString& path, const QString& origin,
                      const std::string& disk) {
    ReadScene read = readAside([&] { return readScene(document, {}, directoryOf(path)); });
    if (!read.errors.empty()) {
        report(tr("The scene"), read.errors);
        return false;
    }
    path_ = path;
    origin_ = origin.isEmpty() ? path : origin;
    disk_->takeKnown(path_, disk);
    notices_.dismiss("disk");
    notices_.dismiss("save");
    drafts_.clear();
    problems_.clear();
    history_.clear();
    saved_ = Value();
    Value complete = completed(read.scene, document);
    setDocument(std::move(complete), std::move(read));
    selectScheme(-1);
    emit opened();
    announce();
    return true;
}

std::string Workspace::diskMark() const { return path_.isEmpty() ? std::string() : disk_->known(); }

std::string Workspace::textFor(const QString& path) const {
    return writeJson(completed(namedFrom(directoryOf(path), scene_), document_));
}

bool Workspace::save() {
    if (path_.isEmpty()) return false;
    if (!disk_->isChanged(textFor(path_))) return saveAs(path_);
    tellOfChange(tr("%1 was not saved, as the file was changed since it was read").arg(fileName()));
    return false;
}

void Workspace::tellOfChange(const QString& what) {
    notices_.post({Notice::Kind::warning,
                   "disk",
                   what,
                   isDirty() ? tr("to read it again drops the changes made here") : QString(),
                   {{tr("Reload"), [this] { open(path_); }},
                    {tr("Save anyway"), [this] { saveAs(path_); }},
                    {tr("Save as..."), [this] { emit saveAsWanted(); }}}});
}

bool Workspace::saveAs(const QString& path) {
    const std::string text = textFor(path);
    QSaveFile file(path);
    const bool isWritten =
        file.open(QIODevice::WriteOnly) &&
        file.write(text.data(), static_cast<qint64>(text.size())) == static_cast<qint64>(text.size()) &&
        file.commit();
    if (!isWritten) {
        notices_.post({Notice::Kind::error,
                       "save",
                       tr("%1 was not saved: %2").arg(path, file.errorString()),
                       tr("choose another folder with Save As (Ctrl+Shift+S)"),
                       {}});
        return false;
    }
    notices_.dismiss("save");
    notices_.dismiss("disk");
    path_ = QFileInfo(path).absoluteFilePath();
    origin_ = path_;
    disk_->take(path_, text);
    saved_ = document_;
    emit fileChanged();
    return true;
}

QString Workspace::fileName() const {
    if (!path_.isEmpty()) return QFileInfo(path_).fileName();
    if (origin_.startsWith("preset:")) return origin_.mid(7) + ".json";
    return tr("unsaved");
}

void Workspace::selectScheme(int index) {
    if (index == selected_) return;
    selected_ = index;
    emit selectionChanged();
}

}  // namespace extremal
