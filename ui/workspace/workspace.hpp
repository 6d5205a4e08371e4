// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene being worked on: a value, its history, its file.
///
/// The document is always valid and complete: an edit goes through readScene(), and one that is refused
/// leaves the document alone and is kept as a draft with its problems, for the form to show in place,
/// wherever in the scene they are found: a run that is too long is found at the step of a scheme. A later
/// edit takes the drafts along, so that two fields that are only valid together can be changed one after the
/// other. A refusal that no field shows is said in a banner, and nothing of it is kept.
#pragma once

#include <QObject>
#include <QString>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/scene/scene.hpp"
#include "ui/workspace/document.hpp"
#include "ui/workspace/history.hpp"

namespace extremal {

class DiskFile;
class Notices;
struct ReadScene;
struct ResolvedScene;

class Workspace : public QObject {
    Q_OBJECT
public:
    explicit Workspace(Notices& notices, QObject* parent = nullptr);

    bool hasScene() const { return resolved_ != nullptr; }
    const Scene& scene() const { return scene_; }
    const Value& document() const { return document_; }
    /// What runs: the scene with its model and schemes, made when it was read. Null: there is no scene.
    const std::shared_ptr<const ResolvedScene>& resolved() const { return resolved_; }
    const std::vector<Problem>& warnings() const { return warnings_; }

    /// Makes the edits, or refuses them: then refusalAt() says why. `what` names the change for Undo.
    bool edit(const std::vector<Edit>& edits, const QString& what, const QString& mergeKey = {});
    /// Makes the edits, or returns why not: for callers that say so themselves. Nothing is kept as a draft.
    std::vector<Problem> tryEdit(const std::vector<Edit>& edits, const QString& what);
    /// What the user typed at this place, as a value or inside of one, and was refused; null: the document
    /// has it.
    const Value* draftAt(const std::string& pointer) const;
    /// Why what was typed at this place or below it was refused: the problems there, and where there are
    /// none, those that it makes at other places of the scene. Empty where nothing was refused.
    std::vector<Problem> refusalAt(const std::string& pointer) const;
    /// A field in sight shows what was refused at this place, and why.
    void claimRefusal(const std::string& pointer);
    /// A place of the scene in words: "RK4, step" for "/schemes/4/step".
    QString placeName(const std::string& pointer) const;
    /// Drops what was typed and refused at this place; what is left may be valid then.
    void dropDraft(const std::string& pointer);
    bool hasDrafts() const { return !drafts_.empty(); }
    const std::map<std::string, Value>& drafts() const { return drafts_; }

    const History& history() const { return history_; }
    void undo();
    void redo();

    /// Opens a path or "preset:NAME". False, with a notice, if that cannot be done, or where the scene names
    /// a file outside its own folder and the user has not agreed to read it.
    bool open(const QString& name, bool isTrusted = false);
    /// Takes a whole document, as for a new scene or a recovered one; it counts as unsaved.
    /// `disk`: the fingerprint that its file had, see diskMark().
    bool adopt(const Value& document, const QString& path = {}, const QString& origin = {},
               const std::string& disk = {});
    /// Why the last scene could not be opened.
    const std::vector<Problem>& openProblems() const { return openProblems_; }
    /// False, with a notice, if it cannot be written or has no file yet, and where the file was changed since
    /// it was read: the notice offers to read it again, to save all the same, or to save elsewhere.
    bool save();
    bool saveAs(const QString& path);  ///< the user has agreed to replace what is there
    /// The fingerprint of the file as it was read or saved last; empty: there is no file, or it is not known.
    std::string diskMark() const;
    QString path() const { return path_; }      ///< empty: not saved yet
    QString origin() const { return origin_; }  ///< SCENE as on the command line: a path or "preset:NAME"
    QString fileName() const;                   ///< for titles: "spring-pendulum.json"
    bool isDirty() const { return hasScene() && !(document_ == saved_); }

    int selectedScheme() const { return selected_; }  ///< -1: none
    void selectScheme(int index);

signals:
    void sceneChanged();  ///< document() is another value
    void draftsChanged();
    void fileChanged();  ///< path or dirty state
    void opened();       ///< another scene altogether
    void agreedToRead(
        const QString& name);  ///< files outside the folder of this scene, which is not open yet
    void selectionChanged();
    void saveAsWanted();  ///< the user wants to choose another file

private:
    bool accept(const std::vector<Edit>& edits, const Value* instead = nullptr);
    std::vector<Edit> draftsBeside(const std::vector<Edit>& edits) const;
    /// Why the edits cannot be made, alone and with what was refused before; nothing: they are made.
    struct Refusal {
        std::vector<Problem> alone, together;
    };
    std::optional<Refusal> attempt(const std::vector<Edit>& edits, const QString& what,
                                   const QString& mergeKey);
    void post(const QString& what, const std::vector<Problem>& problems);
    void announce();
    void setDocument(Value document, ReadScene read);
    EditState state() const { return {document_, drafts_}; }
    void restore(const EditState& state);
    void report(const QString& name, const std::vector<Problem>& problems);
    std::string textFor(const QString& path) const;
    void tellOfChange(const QString& what);

    Notices& notices_;
    Scene scene_;
    std::shared_ptr<const ResolvedScene> resolved_;
    Value document_, saved_;
    std::vector<Problem> warnings_, problems_, openProblems_;
    std::map<std::string, Value> drafts_;
    std::vector<std::string> unclaimed_;  ///< places of a refused edit, until a field shows it
    History history_;
    QString path_, origin_;
    DiskFile* disk_;
    int selected_ = -1;
    int revision_ = 0;  ///< counts documents
};

}  // namespace extremal
