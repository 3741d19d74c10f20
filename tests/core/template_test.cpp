#include "core/template.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

std::string rendered(std::string_view text, TemplateData const& data, TemplateTags tags = {}) {
    return render(text, data, tags);
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

TEST(Template, OtherTagsMayBeChosen) {
    TemplateData data;
    data.set("SPEED", "\"fast\"");
    EXPECT_EQ(rendered("a = \"@SPEED@\"\nb = f\"{{x}}\"\n", data, {"\"@", "@\""}),
              "a = \"fast\"\nb = f\"{{x}}\"\n");
}

TEST(Template, MalformedTextsAreRefused) {
    for (char const* text : {"{{#open}}", "{{open", "{{/closed}}"})
        EXPECT_THROW(rendered(text, {}), std::logic_error) << text;
}

TEST(Template, PartsAreInserted) {
    TemplateTexts const texts{{"whole", "a\n{{> folder/part}}\n{{> folder/part}}c\n"},
                              {"folder/part", "{{#shown}}\n{{> inner}}\n{{/shown}}\n"},
                              {"inner", "b{{x}}"},
                              {"loop", "{{> loop}}"},
                              {"lost", "{{> none}}"},
                              {"open", "{{> inner"}};
    TemplateData data;
    data.set("x", "1");
    data.set("shown", true);
    EXPECT_EQ(render(texts, "whole", data), "a\nb1\n\nb1\nc\n");
    EXPECT_THROW(render(texts, "none", data), std::out_of_range);
    EXPECT_THROW(render(texts, "lost", data), std::out_of_range);
    EXPECT_THROW(render(texts, "loop", data), std::logic_error);
    EXPECT_THROW(render(texts, "open", data), std::logic_error);
}

}  // namespace
}  // namespace vibrotrough::core
