// Binding of the words of one line.
#include "bound.hpp"

namespace kaya::lang {
namespace {

TEST(Binder, BrickLimitsDefaultToThoseOfX) {
    const auto whole = bound_as<PolyBrick>("poly brick -0.15,0.15 -0.10,0.10 -0.10,0.0");
    EXPECT_EQ(whole.x, (std::array{-0.15, 0.15}));
    EXPECT_EQ(whole.y, (std::array{-0.10, 0.10}));
    EXPECT_EQ(whole.z, (std::array{-0.10, 0.0}));
    const auto cube = bound_as<PolyBrick>("poly brick (0,2)");
    EXPECT_EQ(cube.y, (std::array{0.0, 2.0}));
    EXPECT_EQ(cube.z, (std::array{0.0, 2.0}));
    const auto flat = bound_as<PolyBrick>("poly brick 0 2 0 1 region 3");
    EXPECT_EQ(flat.y, (std::array{0.0, 1.0}));
    EXPECT_EQ(flat.z, (std::array{0.0, 2.0}));
    EXPECT_EQ(flat.options.region, 3);
}

TEST(Binder, ATitleMayFollowOnTheNextLine) {
    const auto deck = [](const std::string& text) { return bind_text(classic(), source_from_text("deck", text), {}); };
    const auto title = [](const BoundFile& file) {
        return std::any_cast<Title>(file.steps.front().command.command).text;
    };
    const auto below = deck("title\n  Arch, second try\ncycle 1\n");
    EXPECT_EQ(title(*below), "Arch, second try");
    EXPECT_EQ(below->steps.size(), 2u);
    const auto bare = deck("title\ncycle 1\n");
    EXPECT_EQ(title(*bare), "");
    EXPECT_EQ(bare->steps.size(), 2u);
    EXPECT_THROW(deck("title\ncylce 1\n"), DeckErrors) << "a misspelt command is no title";
    EXPECT_THROW(deck("title\ncycle many\n"), DeckErrors);
}

TEST(Binder, OptionsStandBeforeOrAfterTheShape) {
    const auto before = bound_as<PolyBrick>("poly region 3 mat 2 brick 0 1 0 1 0 1 cons 4");
    EXPECT_EQ(before.options.region, 3);
    EXPECT_EQ(before.options.material, 2);
    EXPECT_EQ(before.options.constitutive, 4);
    EXPECT_EQ(before.place.column, 1);
    EXPECT_EQ(mistake("poly region 3 brik 0 1").message, "'brik' is not a kind of poly");
    EXPECT_EQ(mistake("poly region 3").message, "a word is missing after '3'");
}

TEST(Binder, PropertyWordsAreWrittenOut) {
    const auto p = bound_as<Property>("prop mat=1 density = 0.0026 k=4e3 g=3e3");
    EXPECT_FALSE(p.joint);
    ASSERT_EQ(p.items.size(), 3u);
    EXPECT_EQ(p.items[0].word, "density");
    EXPECT_EQ(p.items[1].word, "bulk");
    EXPECT_EQ(p.items[2].word, "shear");
    EXPECT_EQ(p.items[1].value, 4e3);
    EXPECT_EQ(p.items[1].place.column, 29);
    const auto j = bound_as<Property>("prop jmat 3 JFriction 30 jco 5 jrco 15 sigmac 150");
    EXPECT_TRUE(j.joint);
    EXPECT_EQ(j.number, 3);
    EXPECT_EQ(j.items[0].word, "jfric");
    EXPECT_EQ(j.items[1].word, "jcoh");
    EXPECT_EQ(j.items[2].word, "jrco") << "not residual cohesion: the word of a joint model";
    EXPECT_EQ(j.items[3].word, "sigmac");
}

TEST(Binder, JointModelCommands) {
    using Action = JointModelCommand::Action;
    const auto load = bound_as<JointModelCommand>("jmodel load my-model");
    EXPECT_EQ(load.action, Action::load);
    EXPECT_EQ(load.model, "my-model");
    EXPECT_EQ(load.model_place.column, 13);
    const auto assign = bound_as<JointModelCommand>("jmodel model mohr jkn 1e5 range z 0");
    EXPECT_EQ(assign.action, Action::assign);
    EXPECT_EQ(assign.model_place.column, 14);
    EXPECT_EQ(assign.items.size(), 1u);
    EXPECT_EQ(assign.range.elements.size(), 1u);
    const auto values = bound_as<JointModelCommand>("jmodel lo = 0.1 mo 2");
    EXPECT_EQ(values.action, Action::properties);
    ASSERT_EQ(values.items.size(), 2u) << "lo and mo are properties, not load and model";
    EXPECT_EQ(values.items[0].word, "lo");
}

TEST(Binder, Boundary) {
    const auto v = bound_as<Boundary>("bound xvel = 0 zvel=-2 yfree range zr -1 0.01");
    EXPECT_EQ(v.velocity[0], 0.0);
    EXPECT_FALSE(v.velocity[1]);
    EXPECT_EQ(v.velocity[2], -2.0);
    EXPECT_TRUE(v.free[1]);
    EXPECT_EQ(v.range.elements.size(), 1u);
    const auto s = bound_as<Boundary>("bound str 0 0 -5 0 0 0 zgrad 0 0 1 0 0 0 range z .09 .11");
    EXPECT_EQ((*s.stress)[2], -5);
    EXPECT_EQ(s.z_gradient[2], 1);
}

TEST(Binder, Histories) {
    const auto h = bound_as<HistoryAdd>("hist sdis -1 1 0 NDIS (0,0,0) @njdisp unbal ncyc 5");
    ASSERT_EQ(h.items.size(), 4u);
    EXPECT_EQ(std::get<HistoryItem::Quantity>(h.items[0].what).field, "shear_displacement");
    EXPECT_EQ(h.items[0].place, Vec3(-1, 1, 0));
    EXPECT_EQ(std::get<HistoryItem::Quantity>(h.items[1].what).field, "normal_displacement");
    EXPECT_EQ(std::get<HistoryItem::Script>(h.items[2].what).symbol, "njdisp");
    EXPECT_EQ(h.items[2].text.column, 31);
    EXPECT_EQ(std::get<HistoryItem::Quantity>(h.items[3].what).field, "unbalanced_force");
    EXPECT_EQ(h.interval, 5);
    EXPECT_EQ(std::get<HistoryItem::Quantity>(bound_as<HistoryAdd>("hist zdisp 0 0 1").items[0].what).field,
              "z_displacement");
    EXPECT_FALSE(bound("hist @a").late) << "a history takes the name, not its value";
    const auto w = bound_as<HistoryWrite>("hist write 2 3 vs 1 'out file.csv'");
    EXPECT_EQ(w.numbers, (std::vector<std::int64_t>{2, 3}));
    EXPECT_EQ(w.versus, 1);
    EXPECT_EQ(w.file, "out file.csv");
    EXPECT_EQ(bound_as<HistoryLabel>("hist label 2 'Shear Stress'").text, "Shear Stress");
}

TEST(Binder, Solution) {
    EXPECT_EQ(bound_as<CycleCommand>("step 10").cycles, 10);
    EXPECT_EQ(bound_as<CycleCommand>("cyc time 0.5").time, 0.5);
    const auto solve = bound_as<Solve>("solve elastic ratio 1e-6 cyc 100 clock 5");
    EXPECT_TRUE(solve.elastic);
    EXPECT_EQ(solve.ratio, 1e-6);
    EXPECT_EQ(solve.cycles, 100);
    EXPECT_EQ(solve.clock, 5);
    const auto rayleigh = bound_as<Damp>("damp 0.05 1.5 mass");
    EXPECT_EQ(rayleigh.kind, Damp::Kind::rayleigh);
    EXPECT_EQ(rayleigh.fraction, 0.05);
    EXPECT_EQ(rayleigh.frequency, 1.5);
    EXPECT_TRUE(rayleigh.mass);
    EXPECT_FALSE(rayleigh.stiffness);
    EXPECT_FALSE(bound_as<Damp>("damp local").value);
    EXPECT_EQ(bound_as<Damp>("damp local 0.7").value, 0.7);
}

TEST(Binder, SettingsAndLists) {
    const auto set = bound_as<Set>("set jcondf 2 dyn on log off pagination off @load = 5e6 @name 'x'");
    EXPECT_EQ(set.default_joint_constitutive, 2);
    EXPECT_EQ(set.dynamic, true);
    EXPECT_EQ(set.log, false);
    ASSERT_EQ(set.fish.size(), 2u);
    EXPECT_EQ(set.fish[0].first, "load");
    EXPECT_EQ(std::get<double>(set.fish[0].second), 5e6);
    EXPECT_EQ(std::get<std::string>(set.fish[1].second), "x");
    EXPECT_EQ(bound_as<List>("print @a @b").symbols, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(bound_as<List>("pri max").what, List::What::extremes);
    EXPECT_EQ(bound_as<List>("list gp range z 0").what, List::What::gridpoints);
}

TEST(Binder, LinesTakenVerbatim) {
    EXPECT_EQ(bound_as<Title>("title Don't (stop) ; really").text, "Don't (stop)");
    EXPECT_EQ(bound_as<Title>("title 'quoted; text'").text, "quoted; text");
    EXPECT_EQ(bound_as<Title>("TITLE").text, "");
    EXPECT_EQ(bound_as<Movie>("mov hist 1 vs 'x &\n more").words.size(), 4U);
    EXPECT_EQ(bound_as<Plot>("pl hist 1 vs 'x &\n more").words.size(), 4u);
    const auto plotted = bound_as<Plot>("pl block Group range z 0 1 group 'a b'");
    ASSERT_EQ(plotted.words.size(), 2u);
    EXPECT_EQ(plotted.words[1].folded, "group");
    EXPECT_EQ(plotted.range, "range z 0 1 group 'a b'");
}

TEST(Binder, ScriptsAreTakenWhole) {
    const auto fish =
        bound_as<FishDefinition>("\ndef av_str ; comment\n  if a\n  endif ; don't\n  'open\nEND ; done\n");
    EXPECT_EQ(fish.text, "def av_str ; comment\n  if a\n  endif ; don't\n  'open\nEND ; done\n");
    EXPECT_EQ(fish.place.line, 2);
    const auto lua = bound_as<LuaChunk>("lua\nfor i = 1, 2 do\nend\nendlua");
    EXPECT_EQ(lua.text, "for i = 1, 2 do\nend\n") << "a Lua end ends no chunk";
    EXPECT_EQ(lua.place.line, 2);
    EXPECT_EQ(bound_as<LuaFile>("lua file.lua").file, "file.lua");
    EXPECT_EQ(bound_as<FishCall>("@wall(1, 'a b') ; x").expression, "wall(1, 'a b')");
    EXPECT_EQ(bound_as<FishCall>("@wall (1, 2)").expression, "wall (1, 2)");
    EXPECT_EQ(bound_as<FishCall>("[a = 1]").expression, "a = 1");
    const auto lines = bound_as<FishCall>("[\na = 1\n b(2)\n]");
    EXPECT_EQ(lines.expression, "[a = 1]");
    ASSERT_EQ(lines.further.size(), 1u);
    EXPECT_EQ(lines.further[0].first, "[b(2)]");
    EXPECT_EQ(lines.further[0].second.line, 3);
    EXPECT_EQ(bound_as<FishCall>("[a = 1] [b = 2]").further[0].first, "b = 2");
    EXPECT_EQ(mistake("[a = 1] new").message, "unexpected 'new' after the bracket");
}

TEST(Binder, UnendedScriptPointsAtItsFirstLine) {
    const Diagnostic d = mistake("def one\n x = 1\n\ndef two\n y = 1\nend");
    EXPECT_EQ(d.message, "define 'one' is never ended");
    EXPECT_EQ(d.place.line, 1);
    EXPECT_EQ(d.hint, "write a line 'end' before 'two' begins in line 4");
    EXPECT_EQ(mistake("def one\n x = 1").hint, "write a line 'end' after its last line");
}

TEST(Binder, AFunctionInsideOfAnotherIsOneMistake) {
    const Diagnostic d = mistake("def one\n def two\n  y = 1\n end\nend");
    EXPECT_EQ(d.message, "'two' stands inside of define 'one'");
    EXPECT_EQ(d.place.line, 2);
}

TEST(Binder, LettersThatOnlyLookRightAreNamed) {
    EXPECT_EQ(mistake("grav 0 0 \u22129.81").hint, "there is the letter U+2212 in it: write the plain -");
    EXPECT_EQ(mistake("poly\u00a0brick 0 1").hint, "there is the letter U+00A0 in it: write a blank instead");
    EXPECT_EQ(mistake("print \u201cx\u201d").hint, "there is the letter U+201C in it: write the plain \"");
}

TEST(Binder, CommandsOfOtherProgramsGetNoGuess) {
    EXPECT_EQ(mistake("// a note").hint, "a comment begins with ;");
    EXPECT_EQ(mistake("# a note").hint, "a comment begins with ;");
    EXPECT_EQ(mistake("!ls").hint, "'kaya help' lists the commands");
    EXPECT_EQ(mistake("foo1").hint, "'kaya help' lists the commands");
    EXPECT_EQ(mistake("brick poly 0 1 0 1 0 1").hint, "did you mean 'poly brick'?");
}

TEST(Binder, WholeNumbersAreWrittenOutInTheHint) {
    EXPECT_EQ(mistake("cycle 1e3").hint, "write it as 1000");
    EXPECT_EQ(mistake("cycle 1.5").hint, "write it without a point or an exponent");
    EXPECT_EQ(mistake("cycle 1e30").hint, "it is too large: at most 9000000000000000000 is possible");
}

TEST(Binder, MessagesPointAtTheWord) {
    const Diagnostic d = mistake("poly brik 0,1 0,1 0,1");
    EXPECT_EQ(d.code, "unknown-word");
    EXPECT_EQ(render(d), "test.3dd:1:6: error: 'brik' is not a kind of poly\n"
                         "     1 | poly brik 0,1 0,1 0,1\n"
                         "       |      ^^^^ did you mean 'brick'?");
    const Diagnostic missing = mistake("facetri edge ; how long");
    EXPECT_EQ(missing.place.column, 13);
    EXPECT_EQ(missing.hint, "expected: edge, a number, greater than 0 [length]");
    const Diagnostic continued = mistake("bound xvel 0 &\n  yvle 0");
    EXPECT_EQ(continued.place.line, 2);
    EXPECT_EQ(continued.place.column, 3);
    EXPECT_EQ(mistake("genn edge 1").hint, "did you mean 'generate'?");
    EXPECT_EQ(mistake("5 6").message, "'5' is not a command");
    EXPECT_EQ(mistake("gravity 1e999 0 0").message, "1e999 is too large for a number");
    EXPECT_EQ(mistake("group block 'a b").message, "the quote is not closed on this line");
    EXPECT_EQ(mistake("gen edge [1+2").message, "the bracket '[' is not closed on this line");
    EXPECT_EQ(mistake("gen edge @f(2").message, "the parenthesis '(' is not closed on this line");
    EXPECT_EQ(mistake("gen edge @").message, "a name is missing after '@'");
}

TEST(Binder, QuestionMarkListsTheChoices) {
    const Diagnostic d = mistake("solve ?");
    EXPECT_EQ(d.severity, Severity::note);
    EXPECT_NE(d.message.find("ratio"), std::string::npos);
    EXPECT_NE(d.message.find("elastic"), std::string::npos);
    EXPECT_NE(mistake("?").message.find("poly"), std::string::npos);
    EXPECT_NE(mistake("poly ?").message.find("brick"), std::string::npos);
    EXPECT_EQ(mistake("facetri edge ?").message, "expected: edge, a number, greater than 0 [length]");
    EXPECT_NE(mistake("gen edge ?").message.find("edgelength-center"), std::string::npos);
    EXPECT_EQ(mistake("new ?").message, "nothing more is allowed here");
    EXPECT_NE(mistake("hide range plane ?").message.find("above"), std::string::npos);
    EXPECT_NE(mistake("hide range ?").message.find("sphere"), std::string::npos);
    EXPECT_NE(mistake("prop mat 1 ?").message.find("density"), std::string::npos);
}

TEST(Binder, NamesAreWildcardsUntilTheyHaveValues) {
    const BoundCommand late = bound("gen edge @size");
    EXPECT_TRUE(late.late);
    EXPECT_FALSE(bound("gen edge 1").late);
    EXPECT_TRUE(bound("poly brick @a @b [c] [d]").late) << "wildcards are not compared";
    EXPECT_TRUE(bound("poly brick 0 1 region @r").late);
    EXPECT_TRUE(bound("grav @g").late) << "may be a vector";
    EXPECT_TRUE(bound("grav @gx @gy @gz").late);
    EXPECT_TRUE(bound("hide range group @name").late);
    EXPECT_EQ(mistake("gen egde @size").message, "'egde' is not a kind of generate") << "the rest is still checked";
}

TEST(Binder, ValuesOfNames) {
    std::vector<std::string> asked;
    Value answer;
    const ValueSource values = [&](const std::string& expression, const Place&) {
        asked.push_back(expression);
        return answer;
    };
    answer = 0.25;
    EXPECT_EQ(bound_as<GenerateEdge>("gen edge [size*2]", &values).edge, std::optional(0.25));
    EXPECT_EQ(asked, std::vector<std::string>{"size*2"});
    answer = std::int64_t{3};
    EXPECT_EQ(bound_as<GenerateEdge>("gen edge @n", &values).edge, std::optional(3.0));
    EXPECT_EQ(bound_as<CycleCommand>("cycle @n", &values).cycles, 3);
    answer = 3.0;
    EXPECT_EQ(bound_as<CycleCommand>("cycle @n", &values).cycles, 3) << "a whole real is a whole number";
    answer = Vec3(1, 2, 3);
    asked.clear();
    EXPECT_EQ(bound_as<Gravity>("grav @g", &values).value, Vec3(1, 2, 3));
    EXPECT_EQ(asked.size(), 1u) << "a function with side effects is called once";
    answer = std::string("left");
    EXPECT_EQ(bound_as<Hide>("hide range group @name", &values).range.elements[0].name, "left");

    const auto refused = [&](const char* text) {
        try {
            bound(text, &values);
        } catch (const Diagnostic& d) { return d.message; }
        return std::string("accepted");
    };
    EXPECT_EQ(refused("gen edge @name"), "'@name' is a text, and must be a number");
    answer = 2.5;
    EXPECT_EQ(refused("cycle @n"), "'@n' is a number, and must be a whole number");
    answer = -1.0;
    EXPECT_EQ(refused("gen edge @n"), "edge must be greater than 0, not -1");
    answer = std::nan("");
    EXPECT_EQ(refused("gen edge @n"), "'@n' is nan, not a usable number");
    answer = std::monostate{};
    EXPECT_EQ(refused("gen edge @n"), "'@n' is nothing yet, and must be a number");
}

TEST(Binder, TextOfACommandForTheJournal) {
    EXPECT_EQ(bound("poly brick  0,1 & ; first\n   0,1 0,1").text(), "poly brick  0,1 0,1 0,1");
    EXPECT_EQ(bound("def f\n a = 1\nend").text(), "def f\n a = 1\nend");
}

} // namespace
} // namespace kaya::lang
