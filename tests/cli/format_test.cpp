// Mesh formats as the program tells them apart: by content on the way in, by ending on the way out.
#include "program.h"

namespace folprom::cli_test {
namespace {

class Format : public CliTest {};

TEST_F(Format, UnknownInputGivesThreeAndTheKnownOnes) {
  WriteText(Path("scan.gltf"), "{\"asset\": {}}");
  const std::string scan = Path("scan.gltf"), out = Path("out");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"encode", scan, "-o", out},
        {"rd", scan, "-o", out},
        {"compare", scan, scan}}) {
    ExpectError(arguments, 3, "unsupported format (known formats: PLY, OBJ, STL, OFF)");
  }
  EXPECT_EQ(Files(), std::vector<std::string>{"scan.gltf"});
}

TEST_F(Format, UnknownOutputGivesTwoAndTheKnownOnes) {
  ASSERT_EQ(Run({"synth", "--vertices", "200", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  const std::vector<std::string> before = Files();
  const std::string known = "(known: .ply, .obj, .stl, .off)";
  ExpectError({"decode", Path("s.folp"), "-o", Path("s.3mf")}, 2, known);
  ExpectError({"decode", Path("s.folp"), "-o", Path("s")}, 2, known);
  ExpectError({"synth", "--vertices", "200", "-o", Path("s.3mf")}, 2, known);
  EXPECT_EQ(Files(), before);
}

TEST_F(Format, EveryFormatIsWrittenReadAndVerified) {
  ASSERT_EQ(Run({"synth", "--vertices", "500", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "--exact", "-q"}).exit_code, 0);
  for (const std::string ending : {"ply", "obj", "off"}) {
    ASSERT_EQ(Run({"decode", Path("s.folp"), "-o", Path("d." + ending), "-q"}).exit_code, 0);
    EXPECT_EQ(Run({"verify", Path("s.folp"), "--against", Path("d." + ending)}).exit_code, 0);
    ASSERT_EQ(Run({"synth", "--vertices", "500", "-o", Path("t." + ending), "-q"}).exit_code, 0);
    EXPECT_EQ(Run({"verify", Path("s.folp"), "--against", Path("t." + ending)}).exit_code, 0);
    EXPECT_EQ(Run({"compare", Path("s.ply"), Path("d." + ending), "-q"}).exit_code, 0);
  }
}

TEST_F(Format, WhatTheOutputDoesNotHoldIsAWarning) {
  ASSERT_EQ(Run({"synth", "--vertices", "500", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  const Outcome json = Run({"decode", Path("s.folp"), "-o", Path("d.stl"), "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  ASSERT_EQ(json.json().at("warnings").size(), 1u);
  EXPECT_NE(json.json().at("warnings")[0].get<std::string>().find("STL holds facets alone"),
            std::string::npos);
  const Outcome synth = Run({"synth", "--vertices", "500", "-o", Path("t.stl")});
  EXPECT_NE(synth.err.find("STL holds facets alone"), std::string::npos) << synth.err;
  EXPECT_TRUE(
      Run({"decode", Path("s.folp"), "-o", Path("d.off"), "--json"}).json().at("warnings").empty());
}

TEST_F(Format, WhatTheInputHoldsBesideTheMeshIsAWarning) {
  WriteText(Path("a.obj"), "g one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nl 1 2\nf 1 2 3\n");
  const Outcome outcome = Run({"encode", Path("a.obj"), "-o", Path("a.folp"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(
      outcome.json().at("warnings"),
      std::vector<std::string>{"properties not kept: texture coordinates (vt), line elements (l)"});
}

}  // namespace
}  // namespace folprom::cli_test
