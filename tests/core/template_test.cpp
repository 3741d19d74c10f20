#include "core/template.hpp"

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <kainjow/mustache.hpp>

namespace vibrotrough::core {
namespace {

namespace mustache = kainjow::mustache;

std::string rendered(std::string_view text, TemplateData const& data, TemplateTags tags = {}) {
    return Template(text, tags).render(data);
}

TEST(Template, TextsAreInsertedUnchanged) {
    TemplateData data;
    data.set("x", "<a & \"b\">");
    EXPECT_EQ(rendered("1 {{x}} {{{x}}} {{&x}} 2", data), "1 <a & \"b\"> <a & \"b\"> <a & \"b\"> 2");
    EXPECT_EQ(rendered("{{nothing}}.", data), ".");
    data.set("x", "again");
    EXPECT_EQ(rendered("{{x}}", data), "again") << "the last value counts";
    data.set("x", "{{x}}");
    EXPECT_EQ(rendered("{{x}}", data), "{{x}}") << "a value is not a template";
}

TEST(Template, SectionsAreShownOrRepeated) {
    TemplateData data, one, two;
    data.set("yes", true);
    data.set("no", false);
    data.set("name", "outer");
    one.set("name", "1");
    data.set("list", std::vector{one, two});
    EXPECT_EQ(rendered("{{#yes}}a{{/yes}}{{^yes}}b{{/yes}}{{#no}}c{{/no}}{{^no}}d{{/no}}", data), "ad");
    EXPECT_EQ(rendered("{{#list}}\n{{name}}\n{{/list}}\n", data), "1\nouter\n");
    data.set("list", std::vector<TemplateData>{});
    EXPECT_EQ(rendered("{{#list}}x{{/list}}.", data), ".");
}

TEST(Template, DataIsCopiedWhole) {
    TemplateData data, element;
    element.set("name", "1");
    data.set("list", std::vector{element});
    TemplateData copy = data;
    data.set("list", std::vector<TemplateData>{});
    EXPECT_EQ(rendered("{{#list}}{{name}}{{/list}}", copy), "1");
    copy = data;
    EXPECT_EQ(rendered("{{#list}}{{name}}{{/list}}.", copy), ".");
}

TEST(Template, OtherTagsMayBeChosen) {
    TemplateData data;
    data.set("SPEED", "\"fast\"");
    EXPECT_EQ(rendered("a = \"@SPEED@\"\nb = f\"{{x}}\"\n", data, {"\"@", "@\""}),
              "a = \"fast\"\nb = f\"{{x}}\"\n");
}

TEST(Template, OneTemplateRendersManyTimes) {
    Template const text("{{x}}\n");
    for (char const* value : {"1", "2"}) {
        TemplateData data;
        data.set("x", value);
        EXPECT_EQ(text.render(data), std::string(value) + "\n");
    }
}

/// The same data for us and for the library itself.
struct Twins {
    TemplateData ours;
    mustache::data reference{mustache::data::type::object};

    template <typename Value>
    void set(std::string const& name, Value const& value) {
        ours.set(name, value);
        reference.set(name, value);
    }
    void set(std::string const& name, std::vector<Twins> const& list) {
        std::vector<TemplateData> elements;
        mustache::list reference_elements;
        for (Twins const& one : list) {
            elements.push_back(one.ours);
            reference_elements.push_back(one.reference);
        }
        ours.set(name, elements);
        reference.set(name, reference_elements);
    }
};

// One object that has rendered other data gives what the library gives that renders anew, whatever the values
// are: those that make a line blank, which mustache leaves out when it has tags of sections; those that look
// like tags; line feeds; the character that marks places; names that come twice; lists and switches.
TEST(Template, RemembersNothingOfEarlierData) {
    std::string const text =
        "a {{x}}\n{{#yes}}{{x}}{{y}}{{/yes}}\n{{#list}}\n  {{name}}{{^yes}}{{x}}{{/yes}}\n{{/list}}\n"
        "{{#x}}{{.}}{{/x}}|{{{y}}}|\n{{#list}}{{#inner}}<{{name}}{{y}}>{{/inner}}{{/list}}{{x}}";
    std::vector<std::string> const values{"1",
                                          "",
                                          " ",
                                          "\t ",
                                          "{{y}}",
                                          "{{#yes}}",
                                          "\n",
                                          "b\nc",
                                          "\r\n",
                                          "\x1e"
                                          "5\x1e",
                                          "\x1e",
                                          "}}"};
    std::mt19937_64 random(1);
    auto const one_of = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    auto const value = [&] { return values[one_of(values.size())]; };
    mustache::mustache library(text);
    library.set_custom_escape([](std::string const& unchanged) { return unchanged; });
    Template const experienced(text);
    for (int i = 0; i < 3000; ++i) {
        Twins data;
        data.set("x", value());
        if (one_of(2) == 0) data.set("y", value());
        data.set("yes", one_of(2) == 0);
        std::vector<Twins> list(one_of(4));
        for (Twins& element : list) {
            if (one_of(3) > 0) element.set("name", value());
            std::vector<Twins> inner(one_of(3));
            for (Twins& deeper : inner) deeper.set("name", value());
            if (one_of(3) == 0) element.set("inner", inner);
        }
        data.set("list", list);
        if (one_of(4) == 0) data.set("x", value());
        ASSERT_EQ(experienced.render(data.ours), library.render(data.reference)) << i;
    }
}

// Where a tag takes a value for a template, or changes what tags look like, nothing is remembered.
TEST(Template, ValuesMayBeTemplatesWhereATagSaysSo) {
    Template const part("{{>x}}.{{> x }}"), other("{{=<% %>=}}<%x%>{{x}}");
    for (char const* y : {"1", "2"}) {
        TemplateData data;
        data.set("y", y);
        data.set("x", std::string("{{y}}") + y);
        std::string const twice = std::string(y) + y;
        EXPECT_EQ(part.render(data), twice + "." + twice);
        EXPECT_EQ(other.render(data), "{{y}}" + std::string(y) + "{{x}}");
    }
}

TEST(Template, MalformedTextsAreRefused) {
    EXPECT_THROW(Template("{{#open}}"), std::logic_error);
    EXPECT_THROW(Template("{{open"), std::logic_error);
    EXPECT_THROW(Template("{{/closed}}"), std::logic_error);
}

TEST(Template, PartsAreInserted) {
    static TemplateTexts const texts{{"whole", "a\n{{> folder/part}}\n{{> folder/part}}c\n"},
                                     {"folder/part", "{{#shown}}\n{{> inner}}\n{{/shown}}\n"},
                                     {"inner", "b{{x}}"},
                                     {"loop", "{{> loop}}"},
                                     {"lost", "{{> none}}"},
                                     {"open", "{{> inner"}};
    TemplateData data;
    data.set("x", "1");
    data.set("shown", true);
    EXPECT_EQ(parsed_template(texts, "whole").render(data), "a\nb1\n\nb1\nc\n");
    EXPECT_EQ(&parsed_template(texts, "whole"), &parsed_template(texts, "whole")) << "parsed once";
    EXPECT_THROW(parsed_template(texts, "none"), std::out_of_range);
    EXPECT_THROW(parsed_template(texts, "lost"), std::out_of_range);
    EXPECT_THROW(parsed_template(texts, "loop"), std::logic_error);
    EXPECT_THROW(parsed_template(texts, "open"), std::logic_error);
}

}  // namespace
}  // namespace vibrotrough::core
