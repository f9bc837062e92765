// Job files that are wrong: one message that names the place, the right code, and nothing done.
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "tests/cli/batch_fixture.h"

namespace folprom::cli_test {
namespace {

struct WrongJob {
  const char* name;
  const char* text;
  int exit_code;
  int line;          ///< 0: none is named
  const char* part;  ///< of the message
};

// What is not said about a job is right: there are scans/a.ply and scans/sub/a.ply, c.toml,
// bad.toml, file.txt, and out/theirs.folp.
const WrongJob kWrongJobs[] = {
    {"NoJob", "[defaults]\nbits = 12\n", 2, 0, "has no [[job]]"},
    {"EmptyFile", "", 2, 0, "has no [[job]]"},
    {"Syntax", "[[job]\ninput = 1\n", 2, 1, ""},
    {"KeyTwice", "[[job]]\ninput = \"a\"\ninput = \"b\"\n", 2, 3, "input"},
    {"SingleBrackets", "[job]\ninput = \"scans/*.ply\"\n", 2, 1, "[[job]]"},
    {"UnknownTable", "[default]\nbits = 12\n", 2, 1, "there are [defaults] and [[job]]"},
    {"KeyOutsideTables", "bits = 12\n", 2, 1, "stands outside the tables"},
    {"UnknownKey", "[[job]]\ninptu = \"scans/*.ply\"\n", 2, 2,
     "unknown key job.inptu; the nearest known key is job.input"},
    {"UnknownSetting", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nlenght_weight = 1\n", 2,
     4, "job.length_weight"},
    {"FlagsName", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nsubtree-vertices = 9\n", 2, 4,
     "the nearest known key is job.subtree_vertices"},
    {"KeyOfTheBatch", "[[job]]\nmemory = \"1GiB\"\n", 2, 2, "defaults.memory"},
    {"KeyOfAJob", "[defaults]\ninput = \"scans/*.ply\"\n", 2, 2, "unknown key defaults.input"},
    {"WrongType", "[[job]]\ninput = 5\n", 2, 2, "job.input must be a text in quotes or a list"},
    {"WrongTypeOfSetting", "[defaults]\nbits = \"12\"\n", 2, 2, "defaults.bits must be an integer"},
    {"WrongTypeOfList", "[[job]]\ninput = [\"a\", 3]\n", 2, 2, "job.input must be"},
    {"OutOfRange", "[[job]]\neffort = 10\n", 2, 2, "out of range, must be 1 .. 9"},
    {"MemoryOfNothing", "[defaults]\nmemory = \"2 pounds\"\n", 2, 2, "defaults.memory"},
    {"NoInput", "[[job]]\noutput = \"o\"\n", 2, 1, "job.input is missing"},
    {"NoOutput", "[[job]]\ninput = \"scans/*.ply\"\n", 2, 1, "job.output is missing"},
    {"UnknownOperation",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\noperations = [\"pack\"]\n", 2, 4,
     "\"encode\" or \"decode\" or \"verify\" or \"rd\""},
    {"NoOperation", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\noperations = []\n", 2, 4,
     "operations is empty"},
    {"OperationTwice",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\noperations = [\"encode\", \"encode\"]\n", 2,
     4, "twice"},
    {"RdOfEncodedFiles",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\noperations = [\"decode\", \"rd\"]\n", 2, 4,
     "make two jobs"},
    {"UnknownPolicy", "[defaults]\nexisting = \"replace\"\n", 2, 2, "\"overwrite\""},
    {"UnknownPolicyOfErrors", "[defaults]\non_error = \"ignore\"\n", 2, 2, "\"continue\""},
    {"SameName",
     "[[job]]\nname = \"x\"\ninput = \"scans/*.ply\"\noutput = \"o\"\n[[job]]\nname = \"x\"\n", 2,
     6, "two jobs are called \"x\""},
    {"BitsAndTolerance", "[[job]]\nbits = 12\ntolerance = 0.5\n", 2, 3, "exclude each other"},
    {"ExactAndBits", "[[job]]\nexact = true\nbits = 12\n", 2, 2, "exact = true"},
    {"SettingsThatDoNotGoTogether",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nhierarchy = \"lloyd\"\n", 2, 1,
     "hierarchy = \"quadric\""},
    {"MissingConfig", "[[job]]\nconfig = \"none.toml\"\n", 3, 2, "none.toml"},
    {"WrongConfig", "[[job]]\nconfig = \"bad.toml\"\n", 2, 2, "bad.toml:2: unknown key"},
    {"UnknownField", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\npattern = \"{scan}\"\n", 2,
     4, "unknown field {scan}; there are {stem}"},
    {"OpenBrace", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\npattern = \"{stem\"\n", 2, 4,
     "brace"},
    {"PatternLeadsOut",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\npattern = \"../{stem}\"\n", 2, 4,
     "leads out"},
    {"EmptyPattern", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\npattern = \"\"\n", 2, 4,
     "file name"},
    {"TwoBounds",
     "[[job]]\noperations = [\"encode\", \"decode\"]\nlods = [{ bpv = 2, layers = 3 }]\n", 2, 3,
     "at most one of"},
    {"UnknownBound", "[[job]]\nlods = [{ bits = 2 }]\n", 2, 2, "unknown key job.lods.bits"},
    {"NegativeBound", "[[job]]\nlods = [{ bpv = -2 }]\n", 2, 2, "job.lods.bpv"},
    {"BoundThatIsNone", "[[job]]\nlods = [3]\n", 2, 2, "list of tables"},
    {"WrongRegion", "[[job]]\nlods = [{ region = \"1,2,3\" }]\n", 2, 2, "is not a box"},
    {"LodsWithoutDecode",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nlods = [{ bpv = 2 }]\n", 2, 4,
     "\"decode\" is not among the operations"},
    {"RatesWithoutRd", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nrates = [1]\n", 2, 4,
     "\"rd\" is not among the operations"},
    {"RateOfZero", "[defaults]\nrates = [0]\n", 2, 2, "defaults.rates"},
    {"SameLodTwice",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\noperations = [\"encode\", \"decode\"]\n"
     "lods = [{ bpv = 2 }, { bpv = 2.0 }]\n",
     2, 5, "two entries of lods"},
    {"EmptyGlob", "[[job]]\ninput = \"scans/*.stl\"\noutput = \"o\"\n", 3, 2, "matches no file"},
    {"OneOfTwoGlobsEmpty", "[[job]]\ninput = [\"scans/*.ply\", \"none/*.ply\"]\noutput = \"o\"\n",
     3, 2, "does not exist"},
    {"MissingFile", "[[job]]\ninput = \"scans/b.ply\"\noutput = \"o\"\n", 3, 2, "scans/b.ply"},
    {"AllExcluded", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\nexclude = \"scans/a*\"\n", 3,
     4, "leaves no scan"},
    {"SameStemInTwoFolders", "[[job]]\ninput = \"scans/**/*.ply\"\noutput = \"o\"\n", 2, 1,
     "pattern = \"{folder}/{stem}\" keeps them apart"},
    {"SameStemInAList", "[[job]]\ninput = [\"scans/a.ply\", \"scans/sub/a.ply\"]\noutput = \"o\"\n",
     2, 1, "pattern = \"{folder}/{stem}\" keeps them apart"},
    {"SameOutputOfTwoJobs",
     "[defaults]\noutput = \"o\"\n[[job]]\ninput = \"scans/*.ply\"\n[[job]]\n"
     "input = \"scans/*.ply\"\nbits = 9\n",
     2, 5, "pattern = \"{job}/{stem}\" keeps them apart"},
    {"CircularDecode",
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"scans\"\noperations = [\"encode\", "
     "\"decode\"]\n",
     2, 3, "circular decode"},
    {"GlobMatchesOwnOutputs", "[[job]]\ninput = \"scans/*\"\noutput = \"scans\"\n", 2, 3,
     "would take the output"},
    {"GlobOfAnotherJobMatchesOutputs",
     "[[job]]\nname = \"x\"\ninput = \"out/*.folp\"\noutput = \"p\"\noperations = [\"decode\"]\n"
     "[[job]]\ninput = \"scans/*.ply\"\noutput = \"out\"\n",
     2, 8, "for a scan of job \"x\""},
    {"ReportIsTakenForAScan",
     "[defaults]\nreport = \"scans\"\n[[job]]\ninput = \"scans/*\"\noutput = \"o\"\n", 2, 5,
     "scans/report.json"},
    {"OutputBelowAFile", "[[job]]\ninput = \"scans/*.ply\"\noutput = \"file.txt/o\"\n", 5, 3,
     "file.txt is not a folder"},
    {"ReportBelowAFile",
     "[defaults]\nreport = \"file.txt/r\"\n[[job]]\ninput = \"scans/*.ply\"\noutput = \"o\"\n", 5,
     0, "file.txt/r"},
    {"OutputOfSomebodyElse",
     "[[job]]\ninput = \"scans/a.ply\"\noutput = \"out\"\npattern = \"theirs\"\n", 5, 1,
     "was not made by a batch"},
    {"ExistingFails",
     "[[job]]\ninput = \"scans/a.ply\"\noutput = \"out\"\npattern = \"theirs\"\nexisting = "
     "\"fail\"\n",
     5, 5, "exists already"},
};

class BatchConfig : public BatchTest, public ::testing::WithParamInterface<WrongJob> {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(Path("scans/sub"));
    std::filesystem::create_directory(Path("out"));
    for (const char* scan : {"scans/a.ply", "scans/sub/a.ply"}) WriteText(Path(scan), "ply\n");
    WriteText(Path("c.toml"), "[codec]\neffort = 1\n");
    WriteText(Path("bad.toml"), "[codec]\nefort = 1\n");
    WriteText(Path("file.txt"), "");
    WriteText(Path("out/theirs.folp"), "theirs");
  }

  std::vector<std::string> Everything() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Path("."))) {
      names.push_back(entry.path().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_P(BatchConfig, GivesOneMessageBeforeAnyWork) {
  const WrongJob& wrong = GetParam();
  const std::string path = WriteJob(wrong.text);
  const std::vector<std::string> before = Everything();
  // Line and reason stand in the same message.
  const Outcome outcome = Run({"batch", path});
  EXPECT_EQ(outcome.exit_code, wrong.exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("folprom: ")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(wrong.part), std::string::npos) << outcome.err;
  if (wrong.line > 0) {
    const std::string place = path + ":" + std::to_string(wrong.line) + ": ";
    EXPECT_NE(outcome.err.find(place), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(Everything(), before);
}

INSTANTIATE_TEST_SUITE_P(WrongJobs, BatchConfig, ::testing::ValuesIn(kWrongJobs),
                         [](const auto& job) { return std::string(job.param.name); });

class BatchArguments : public BatchTest {};

TEST_F(BatchArguments, RejectsMissingJobFiles) {
  ExpectError({"batch"}, 2, "JOB.toml");
  ExpectError({"batch", Path("none.toml")}, 3, "none.toml");
  ExpectError({"batch", Path(".")}, 3, "directory");
}

TEST_F(BatchArguments, RejectsAFolderThatMayNotBeWrittenTo) {
  if (::geteuid() == 0) GTEST_SKIP() << "everything may be written to by root";
  WriteText(Path("a.ply"), "ply\n");
  std::filesystem::create_directory(Path("o"));
  std::filesystem::permissions(Path("o"), std::filesystem::perms(0500));
  WriteJob("[[job]]\ninput = \"a.ply\"\noutput = \"o/p\"\n");
  ExpectError({"batch", Path("job.toml")}, 5, "cannot be written to");
}

TEST_F(BatchArguments, ExampleIsWhatTheProgramPrintsAndRuns) {
  const Outcome printed = Run({"batch", "--print-example"});
  ASSERT_EQ(printed.exit_code, 0);
  EXPECT_EQ(printed.out, FileText(FOLPROM_SOURCE_DIR "/configs/batch_example.toml"));
  MakeScan("scans/deep/a.ply", 2000, 1);
  WriteJob(printed.out);
  const Outcome outcome = RunBatch();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(Path("previews/deep/a.preview.ply")));
}

// Every key that stands as a comment can be set, to what the comment says, and changes nothing.
TEST_F(BatchArguments, EveryKeyOfTheExampleIsRead) {
  const std::string text = FileText(FOLPROM_SOURCE_DIR "/configs/batch_example.toml");
  std::string all;
  std::istringstream lines(text.substr(0, text.find("[[job]]")));
  size_t keys = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool key = line.size() > 1 && line[0] == '#' && line[1] != ' ';
    // Of these one alone can be given.
    if (!key || line.starts_with("#tolerance") || line.starts_with("#exact")) continue;
    all += line.substr(1) + "\n";
    ++keys;
  }
  EXPECT_GT(keys, 40);
  MakeScan("scans/a.ply", 500, 1);
  const std::string job = "[[job]]\ninput = \"scans/a.ply\"\noutput = \"out\"\n";
  WriteJob("[defaults]\n" + all + job);
  ASSERT_EQ(RunBatch().exit_code, 0) << RunBatch().err;
  WriteJob(job);
  ASSERT_EQ(RunBatch().exit_code, 0);
  EXPECT_EQ(Statuses().at("encode a.ply"), "up_to_date");
}

}  // namespace
}  // namespace folprom::cli_test
