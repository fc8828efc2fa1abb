// Three articles on depth of field, each as a scene with its own look, its controls and all of its buffers.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace petzval::view {

struct ArticleControl {
    std::string path, label;
    double least = 0, most = 0;  // of a slider; both 0: the field's own widget
};

struct ArticleBuffer {
    std::string label, shown;  // one of shown_names()
    std::string stage;         // of engine gather; empty: whatever it is
};

struct Article {
    std::string scene, title;
    std::vector<std::pair<std::string, std::string>> fields;  // where no look is chosen
    std::vector<ArticleControl> controls;
    std::vector<ArticleBuffer> buffers;
};

// The article of that scene; null: none.
const Article* article_of(const std::string& scene);

class App;
void begin_article(App& app);
// Draws into ImGui's current window.
void article_panel(App& app);

}  // namespace petzval::view
