// An interrupted operation on a saved session is applied completely or not at all, in the session and its
// catalogue.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "core/catalogue/object_database.h"
#include "core/session/open_session.h"
#include "core/session/session_catalogue.h"
#include "tests/pipeline/session/scan_worker_fixture.h"
#include "tests/support/other_program.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using test::OtherProgram;
using test::ScanWorkerTest;

/// A write that fails: that of a row of `table` for which `condition` holds.
struct FailingWrite {
  const char* file;  ///< in the session folder
  const char* table;
  const char* condition;
};

constexpr const char *kSession = "session.sqlite", *kCatalogue = "catalogue.sqlite";
constexpr FailingWrite kOperation{kSession, "operations", "number > 0"};
constexpr FailingWrite kPending{kSession, "facts", "name = 'pending edits'"};
constexpr FailingWrite kCatalogueSteps[]{{kCatalogue, "events", "action = 'session-begin' AND id > N"},
                                         {kCatalogue, "events", "action = 'add' AND id > N"},
                                         {kCatalogue, "events", "action = 'add-view' AND id > N"},
                                         {kCatalogue, "events", "action = 'session-end' AND id > N"},
                                         {kCatalogue, "events", "action = 'rename' AND id > N"},
                                         {kCatalogue, "events", "action = 'confirm' AND id > N"},
                                         {kCatalogue, "applied_edits", "token <> ''"}};
constexpr FailingWrite kResult{kSession, "facts", "name LIKE 'namings %'"};

class InterruptedEditsTest : public ScanWorkerTest {
 protected:
  void SetUp() override {
    static const test::TemporaryFolder scanned;  // by the first test of the process
    if (!fs::exists(scanned / "scan")) {
      ASSERT_NO_FATAL_FAILURE(scanInto(scanned / "scan"));
    }
    fs::copy(scanned / "scan", folder_ / "scan", fs::copy_options::recursive);
    const auto session = open();
    ASSERT_TRUE(session);
    const auto regions = session->regions();
    ASSERT_TRUE(regions);
    std::int64_t most = 0;
    for (const RegionSummary& region : *regions) {
      if (region.label.object || region.voxels <= most) continue;
      most = region.voxels;
      region_ = region.region;
    }
    ASSERT_TRUE(region_);
    objects_before_ = rowsOf("objects");
  }

  void scanInto(const fs::path& folder) {
    ScanRequest scan = request(12);
    scan.output_folder = folder;
    scan.database = (folder / kCatalogue).string();
    worker_.post(StartScan{scan});
    worker_.wait();
    ASSERT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  }
  [[nodiscard]] std::unique_ptr<OpenSession> open() const {
    auto session = OpenSession::open(folder_ / "scan");
    EXPECT_TRUE(session) << session.error().message();
    return session ? std::move(*session) : nullptr;
  }
  [[nodiscard]] std::string ask(const char* file, const QString& sql) const {
    return OtherProgram((folder_ / "scan" / file).string()).ask(sql);
  }
  /// Rows of a catalogue table, including hidden ones.
  [[nodiscard]] int rowsOf(const char* table) const {
    return std::stoi(ask(kCatalogue, QString("SELECT count(*) FROM %1").arg(table)));
  }
  /// Makes the write fail while it lives. Sessions and catalogues may have foreign indexes, but no triggers.
  class Blocked {
   public:
    Blocked(const fs::path& folder, const FailingWrite& obstacle) : file_((folder / obstacle.file).string()) {
      OtherProgram program(file_);
      QString condition = obstacle.condition;
      if (condition.contains("id > N"))
        condition.replace("> N", "> " + QString::fromStdString(program.ask("SELECT max(id) FROM events")));
      program.execute(QString("CREATE INDEX obstacle ON %1 (CASE WHEN %2 THEN json('none') END)")
                          .arg(obstacle.table, condition));
    }
    ~Blocked() { OtherProgram(file_).execute("DROP INDEX obstacle"); }
    Blocked(const Blocked&) = delete;
    Blocked& operator=(const Blocked&) = delete;

   private:
    std::string file_;
  };

  [[nodiscard]] Operation naming(const std::string& name) const {
    return {.kind = OperationKind::name, .regions = {region_}, .name = name};
  }
  /// Opens, names and closes, as the program does. Result: whether all of it succeeded.
  [[nodiscard]] bool nameAndClose(const std::string& name) const {
    const auto session = open();
    return session && session->edit(naming(name)) && applyToCatalogue(*session);
  }
  void expectOneObjectNamed(const std::string& name) const {
    const auto session = open();  // opening completes the interrupted edit
    ASSERT_TRUE(session);
    EXPECT_TRUE(session->pendingEdits().empty());
    EXPECT_EQ(session->noteOf(region_).name, name);
    EXPECT_EQ(rowsOf("objects"), objects_before_ + 1) << "one new object, and no hidden one";
    EXPECT_EQ(ask(kCatalogue, "SELECT count(*) FROM sessions WHERE ended IS NULL"), "0");
    const auto database = ObjectDatabase::open((folder_ / "scan" / kCatalogue).string());
    ASSERT_TRUE(database);
    const auto object = (*database)->object(session->objectOf(region_));
    ASSERT_TRUE(object) << object.error().message();
    EXPECT_EQ(object->name, name);
    EXPECT_TRUE(object->confirmed);
  }

  RegionId region_;  // the largest region without an object
  int objects_before_ = 0;
};

TEST_F(InterruptedEditsTest, NameIsNotInTheCatalogue_WhenTheSessionCannotStoreIt) {
  for (const FailingWrite& obstacle : {kOperation, kPending}) {
    {
      const Blocked blocked(folder_ / "scan", obstacle);
      EXPECT_FALSE(nameAndClose("cup"));
    }
    const auto session = open();
    ASSERT_TRUE(session);
    EXPECT_TRUE(session->history().entries().empty()) << obstacle.condition;
    EXPECT_EQ(session->noteOf(region_).name, "");
    EXPECT_TRUE(session->pendingEdits().empty());
    EXPECT_EQ(rowsOf("objects"), objects_before_);
  }
  EXPECT_TRUE(nameAndClose("cup"));
  expectOneObjectNamed("cup");
}

TEST_F(InterruptedEditsTest, NameGivesOneObject_WhereverTheCatalogueFails) {
  const fs::path original = folder_ / "original";
  fs::copy(folder_ / "scan", original, fs::copy_options::recursive);
  for (const FailingWrite& obstacle : kCatalogueSteps) {
    SCOPED_TRACE(obstacle.condition);
    fs::remove_all(folder_ / "scan");
    fs::copy(original, folder_ / "scan", fs::copy_options::recursive);
    {
      const Blocked blocked(folder_ / "scan", obstacle);
      for (int i = 0; i < 2; ++i) EXPECT_FALSE(nameAndClose("cup")) << "each attempt fails";
      EXPECT_EQ(rowsOf("objects"), objects_before_) << "nothing is written";
    }
    expectOneObjectNamed("cup");
  }
}

TEST_F(InterruptedEditsTest, NameGivesOneObject_WhenTheSessionCannotStoreTheResult) {
  {
    const Blocked blocked(folder_ / "scan", kResult);
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(nameAndClose("cup"));
    EXPECT_EQ(rowsOf("objects"), objects_before_ + 1) << "the catalogue has the object";
  }
  expectOneObjectNamed("cup");
}

TEST_F(InterruptedEditsTest, InterruptedUndoRemovesTheObjectOnce) {
  ASSERT_TRUE(nameAndClose("cup"));
  const auto undoAndClose = [this] {
    const auto session = open();
    return session && session->undo() && applyToCatalogue(*session);
  };
  {
    const Blocked blocked(folder_ / "scan", {kCatalogue, "events", "action = 'remove' AND id > N"});
    EXPECT_FALSE(undoAndClose());
  }
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_FALSE(session->objectOf(region_));
  EXPECT_EQ(ask(kCatalogue, "SELECT count(*) FROM objects WHERE name = 'cup'"), "0");
  ASSERT_TRUE(session->redo());
  ASSERT_TRUE(applyToCatalogue(*session));
  EXPECT_EQ(rowsOf("objects"), objects_before_ + 1) << "the same object is restored";
  EXPECT_EQ(ask(kCatalogue, "SELECT count(*) FROM objects WHERE name = 'cup' AND hidden = 0"), "1");
}

TEST_F(InterruptedEditsTest, FailedOperationChangesNothingInTheSession) {
  const auto session = open();
  ASSERT_TRUE(session);
  const auto regions = session->regions();
  ASSERT_TRUE(regions);
  ASSERT_GE(regions->size(), 3U);
  std::vector<Operation> operations;
  operations.push_back(
      {.kind = OperationKind::join, .regions = {(*regions)[0].region, (*regions)[1].region}});
  for (const OperationKind kind : {OperationKind::background, OperationKind::reject, OperationKind::object})
    operations.push_back({.kind = kind, .regions = {region_}});
  const std::string state_query =
      "SELECT (SELECT count(*) FROM operations) || ' ' || (SELECT group_concat(fragment || ':' || region) "
      "FROM"
      " fragments) || ' ' || (SELECT group_concat(region || name || background || is_object || rejected) FROM"
      " regions) || ' ' || (SELECT count(*) FROM borders WHERE by_person)";
  const std::string before = ask(kSession, QString::fromStdString(state_query));
  for (const Operation& operation : operations) {
    const Blocked blocked(folder_ / "scan", kOperation);
    EXPECT_FALSE(session->edit(operation)) << toString(operation.kind);
    EXPECT_EQ(ask(kSession, QString::fromStdString(state_query)), before) << toString(operation.kind);
  }
}

TEST_F(InterruptedEditsTest, ResumedScanCompletesThemFirst) {
  {
    const Blocked blocked(folder_ / "scan", kCatalogueSteps[4]);
    EXPECT_FALSE(nameAndClose("cup"));
  }
  ScanRequest scan = request(3);
  scan.output_folder = folder_ / "scan";
  scan.database.clear();
  scan.resume = true;
  worker_.post(StartScan{scan});
  worker_.wait();
  ASSERT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_EQ(ask(kCatalogue, "SELECT count(*) FROM objects WHERE name = 'cup'"), "1");
  EXPECT_EQ(ask(kSession, "SELECT value FROM facts WHERE name = 'pending edits'"), "");
}

TEST_F(InterruptedEditsTest, JoinIsCompletedOnce_AndUndoRestoresTheObject) {
  std::vector<RegionId> pair{region_};
  {
    const auto session = open();
    ASSERT_TRUE(session);
    const std::vector<RegionSummary> regions = session->regions().value();
    for (const RegionSummary& region : regions) {
      if (region.label.object && pair.size() < 2) pair.push_back(region.region);
    }
    ASSERT_EQ(pair.size(), 2U);
    ASSERT_TRUE(session->edit({.kind = OperationKind::object, .regions = {region_}}));
    ASSERT_TRUE(applyToCatalogue(*session));
  }
  const char* visible = "SELECT group_concat(id || ' ' || name || confirmed) FROM objects WHERE hidden = 0";
  const std::string before = ask(kCatalogue, visible);
  for (const FailingWrite& obstacle :
       {FailingWrite{kCatalogue, "applied_edits", "result LIKE '%\"state\":\"done\"%'"},
        FailingWrite{kCatalogue, "events", "action = 'merge' AND id > N"},
        FailingWrite{kSession, "facts", "name LIKE 'join %' AND value LIKE '%done%'"}}) {
    {
      const Blocked blocked(folder_ / "scan", obstacle);
      const auto session = open();
      ASSERT_TRUE(session);
      ASSERT_TRUE(session->edit({.kind = OperationKind::join, .regions = pair}));
      EXPECT_FALSE(applyToCatalogue(*session)) << obstacle.condition;
    }
    const auto session = open();  // opening completes the interrupted edit
    ASSERT_TRUE(session);
    EXPECT_FALSE(isCataloguePending(*session)) << obstacle.condition;
    EXPECT_NE(ask(kCatalogue, visible), before) << obstacle.condition;
    ASSERT_TRUE(session->undo());
    ASSERT_TRUE(applyToCatalogue(*session));
    EXPECT_EQ(ask(kCatalogue, visible), before) << obstacle.condition;
    for (const RegionId region : pair) EXPECT_TRUE(session->objectOf(region)) << region.value;
    EXPECT_NE(session->objectOf(pair[0]), session->objectOf(pair[1]));
  }
}

}  // namespace
}  // namespace scantrove
