// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Elements of today's MJCF in terms of those that the library reads. A frame passes its pose to what it holds. Copy k of
// a replicate has the pose (offset, euler)^k, its names get the number as a suffix, and elements that refer to such
// names (tendons, equalities, contacts) are copied with them.
#include <algorithm>
#include <map>

#include "scenarios/exchange/common/text.hpp"
#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

using scenario::Pose;
using scenario::Vec3;
using tinyxml2::XMLElement;

constexpr int kMostElements = 200000;  ///< limit for a document with its replicas
constexpr const char* kOrientations[] = {"quat", "axisangle", "euler", "xyaxes", "zaxis"};

class Lowering {
  public:
    Lowering(XmlFile& file, Report& report) : file_(file), report_(report), compiler_(compilerOf(file)) {}

    void run() {
        for (XMLElement* e = file_.root()->FirstChildElement("worldbody"); e;
             e = e->NextSiblingElement("worldbody"))
            expandIn(*e);
        for (XMLElement* e = file_.root()->FirstChildElement(); e; e = e->NextSiblingElement()) {
            const std::string_view name(e->Name());
            if (name == "tendon" || name == "equality" || name == "contact") copyReferences(*e);
        }
    }

  private:
    static bool isNamed(const XMLElement& e, std::string_view name) { return name == e.Name(); }

    /// Expands what is below first, so that inner replicas get the first suffix.
    void expandIn(XMLElement& parent) {
        for (XMLElement* child = parent.FirstChildElement(); child;) {
            expandIn(*child);
            XMLElement* next = child->NextSiblingElement();
            if (isNamed(*child, "frame")) flatten(parent, *child);
            if (isNamed(*child, "replicate")) replicate(parent, *child);
            if (isNamed(*child, "frame") || isNamed(*child, "replicate")) parent.DeleteChild(child);
            child = next;
        }
    }

    void flatten(XMLElement& parent, XMLElement& frame) {
        const Pose pose = poseOf(file_, frame, compiler_);
        tinyxml2::XMLNode* after = &frame;
        while (XMLElement* child = frame.FirstChildElement()) {
            passClass(frame, *child);
            move(*child, pose);
            after = parent.InsertAfterChild(after, child);
        }
    }

    void replicate(XMLElement& parent, XMLElement& element) {
        const Place place = file_.place(element);
        int count = 0;
        if (element.QueryIntAttribute("count", &count) != tinyxml2::XML_SUCCESS || count < 1)
            throw Refusal(place, "<replicate> count: expected a number of at least 1");
        Pose between, pose;
        {
            XMLElement* frame = file_.document().NewElement("frame");
            if (const char* offset = element.Attribute("offset")) frame->SetAttribute("pos", offset);
            if (const char* euler = element.Attribute("euler")) frame->SetAttribute("euler", euler);
            between = poseOf(file_, *frame, compiler_);
            file_.document().DeleteNode(frame);
        }
        const char* separator = element.Attribute("sep");
        const std::size_t digits = std::to_string(count - 1).size();
        tinyxml2::XMLNode* after = &element;
        for (int k = 0; k < count; ++k) {
            std::string number = std::to_string(k);
            number = (separator ? separator : "") + std::string(digits - number.size(), '0') + number;
            for (const XMLElement* child = element.FirstChildElement(); child;
                 child = child->NextSiblingElement()) {
                XMLElement* made = file_.copy(*child);
                passClass(element, *made);
                addSuffix(*made, number, place);
                move(*made, pose);
                after = parent.InsertAfterChild(after, made);
            }
            pose = pose * between;
        }
    }

    void passClass(const XMLElement& from, XMLElement& to) {
        const char* given = from.Attribute("childclass");
        if (!given) return;
        const char* key =
            isNamed(to, "body") || isNamed(to, "frame") || isNamed(to, "replicate") ? "childclass" : "class";
        if (!to.Attribute(key)) to.SetAttribute(key, given);
    }

    void addSuffix(XMLElement& e, const std::string& suffix, const Place& place) {
        if (++copies_ > kMostElements) throw Refusal(place, "more than 200000 copies of elements");
        if (const char* given = e.Attribute("name")) {
            const std::string name = given;
            auto& suffixes = suffixes_[name];
            if (std::find(suffixes.begin(), suffixes.end(), suffix) == suffixes.end())
                suffixes.push_back(suffix);
            e.SetAttribute("name", (name + suffix).c_str());
        }
        for (XMLElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement())
            addSuffix(*child, suffix, place);
    }

    /// Applies the pose of a frame to an element of it.
    void move(XMLElement& e, const Pose& frame) {
        if (isNamed(e, "camera") || isNamed(e, "light") || frame == Pose{}) return;
        // The rules refuse these, with a word that leaves them out.
        for (const char* refused : {"attach", "composite", "flexcomp"})
            if (isNamed(e, refused)) return;
        const Place place = file_.place(e);
        if (!isNamed(e, "body") && !isNamed(e, "geom") && !isNamed(e, "site"))
            throw Refusal(place, std::string("<") + e.Name() + "> in a frame with a pose is not read");
        if (!isNamed(e, "body") && hasPoseInDefaults(e.Name()))
            throw Refusal(place, std::string("<") + e.Name() +
                                     "> in a frame, where a default gives such elements a pose, is not read");
        if (const char* ends = e.Attribute("fromto")) {
            std::vector<double> v;
            if (!readNumbers(ends, v) || v.size() != 6) throw Refusal(place, "fromto: expected 6 numbers");
            const Vec3 a = frame * Vec3{v[0], v[1], v[2]}, b = frame * Vec3{v[3], v[4], v[5]};
            e.SetAttribute("fromto", digits({a.x, a.y, a.z, b.x, b.y, b.z}).c_str());
            return;
        }
        const Pose pose = frame * poseOf(file_, e, compiler_);
        for (const char* key : kOrientations) e.DeleteAttribute(key);
        const Vec3& p = pose.position;
        const auto& q = pose.orientation;
        e.SetAttribute("pos", digits({p.x, p.y, p.z}).c_str());
        e.SetAttribute("quat", digits({q.w, q.x, q.y, q.z}).c_str());
    }

    bool hasPoseInDefaults(const char* element) {
        bool found = false;
        const std::function<void(const XMLElement&)> look = [&](const XMLElement& e) {
            for (const XMLElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement()) {
                if (isNamed(*c, "default")) look(*c);
                if (!isNamed(*c, element)) continue;
                found = found || c->Attribute("pos") || c->Attribute("fromto");
                for (const char* key : kOrientations) found = found || c->Attribute(key);
            }
        };
        for (XMLElement* e = file_.root()->FirstChildElement("default"); e;
             e = e->NextSiblingElement("default"))
            look(*e);
        return found;
    }

    /// All suffixes of a name, of nested replicas in turn; empty for a name that was not copied.
    std::vector<std::string> allSuffixes(const std::string& name) const {
        const auto found = suffixes_.find(name);
        if (found == suffixes_.end()) return {};
        std::vector<std::string> all;
        for (const std::string& suffix : found->second) {
            const auto more = allSuffixes(name + suffix);
            if (more.empty()) all.push_back(suffix);
            for (const std::string& next : more) all.push_back(suffix + next);
        }
        return all;
    }

    void copyReferences(XMLElement& section) {
        for (XMLElement* e = section.FirstChildElement(); e;) {
            XMLElement* next = e->NextSiblingElement();
            std::vector<std::string> suffixes;
            forReferences(*e, [&](XMLElement& at, const std::string&, const std::string& name) {
                const auto own = allSuffixes(name);
                if (own.empty()) return;
                if (!suffixes.empty() && suffixes != own)
                    throw Refusal(file_.place(at),
                                  "a reference to replicas of different numbers is not read");
                suffixes = own;
            });
            tinyxml2::XMLNode* after = e;
            for (const std::string& suffix : suffixes) {
                XMLElement* made = file_.copy(*e);
                const char* name = made->Attribute("name");
                if (name) made->SetAttribute("name", (std::string(name) + suffix).c_str());
                forReferences(*made, [&](XMLElement& at, const std::string& key, const std::string& to) {
                    if (suffixes_.contains(to)) at.SetAttribute(key.c_str(), (to + suffix).c_str());
                });
                after = section.InsertAfterChild(after, made);
            }
            if (!suffixes.empty()) section.DeleteChild(e);
            e = next;
        }
    }

    template <class Function>
    static void forReferences(XMLElement& e, const Function& function) {
        for (const char* key : {"site", "site1", "site2", "geom", "geom1", "geom2", "body1", "body2", "joint",
                                "joint1", "joint2"})
            if (const char* name = e.Attribute(key)) function(e, key, std::string(name));
        for (XMLElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement())
            forReferences(*child, function);
    }

    XmlFile& file_;
    Report& report_;
    Compiler compiler_;
    std::map<std::string, std::vector<std::string>> suffixes_;
    int copies_ = 0;
};

/// Paths of meshes and height fields become absolute; directories of <compiler> go away.
void resolveFiles(XmlFile& file, const AssetFolders& assets) {
    std::filesystem::path folder;
    XMLElement* root = file.root();
    for (XMLElement* e = root->FirstChildElement("compiler"); e; e = e->NextSiblingElement("compiler"))
        for (const char* key : {"assetdir", "meshdir"})
            if (const char* given = e->Attribute(key)) {
                folder = given;
                e->DeleteAttribute(key);
            }
    for (XMLElement* asset = root->FirstChildElement("asset"); asset;
         asset = asset->NextSiblingElement("asset"))
        for (XMLElement* e = asset->FirstChildElement(); e; e = e->NextSiblingElement()) {
            const std::string_view kind(e->Name());
            const char* name = e->Attribute("file");
            if (!name || (kind != "mesh" && kind != "hfield")) continue;
            const Place place = file.place(*e);
            if (!e->Attribute("name")) e->SetAttribute("name", std::filesystem::path(name).stem().c_str());
            e->SetAttribute("file", assets.find((folder / name).string(), place).c_str());
        }
}

/// Today's default: a range is a limit unless the file says otherwise.
void setAutoLimits(XmlFile& file) {
    XMLElement* compiler = file.root()->FirstChildElement("compiler");
    bool given = false;
    for (XMLElement* e = compiler; e; e = e->NextSiblingElement("compiler"))
        given = given || e->Attribute("autolimits");
    if (given) return;
    if (!compiler) {
        compiler = file.document().NewElement("compiler");
        file.root()->InsertFirstChild(compiler);
    }
    compiler->SetAttribute("autolimits", "true");
}

}  // namespace

void lower(XmlFile& file, const AssetFolders& assets, Report& report) {
    if (std::string_view(file.root()->Name()) != "mujoco")
        throw Refusal(file.place(*file.root()),
                      std::string("found <") + file.root()->Name() + ">, expected <mujoco>");
    file.expandIncludes(
        [&](const std::string& name, const Place& place) { return assets.find(name, place); });
    Lowering(file, report).run();
    resolveFiles(file, assets);
    setAutoLimits(file);
}

Places collectPlaces(XmlFile& file) {
    Places places;
    places.bodies.push_back({file.shownName(), 0});
    places.gravityCompensation.push_back(0.0);
    std::vector<XMLElement*> worlds;
    for (XMLElement* e = file.root()->FirstChildElement("worldbody"); e;
         e = e->NextSiblingElement("worldbody"))
        worlds.push_back(e);
    const auto addParts = [&](XMLElement& e) {
        for (XMLElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement()) {
            const std::string_view name(c->Name());
            if (name == "joint" || name == "freejoint") places.joints.push_back(file.place(*c));
            if (name == "freejoint") c->DeleteAttribute("align");
            if (name == "geom") places.geoms.push_back(file.place(*c));
        }
    };
    const std::function<void(XMLElement&)> addBody = [&](XMLElement& e) {
        places.bodies.push_back(file.place(e));
        places.gravityCompensation.push_back(e.DoubleAttribute("gravcomp", 0.0));
        e.DeleteAttribute("gravcomp");
        addParts(e);
        for (XMLElement* c = e.FirstChildElement("body"); c; c = c->NextSiblingElement("body")) addBody(*c);
    };
    for (XMLElement* world : worlds) addParts(*world);
    for (XMLElement* world : worlds)
        for (XMLElement* c = world->FirstChildElement("body"); c; c = c->NextSiblingElement("body"))
            addBody(*c);
    const auto list = [&](const char* section, std::vector<Place>& out) {
        for (XMLElement* e = file.root()->FirstChildElement(section); e; e = e->NextSiblingElement(section))
            for (XMLElement* c = e->FirstChildElement(); c; c = c->NextSiblingElement())
                out.push_back(file.place(*c));
    };
    list("equality", places.equalities);
    list("tendon", places.tendons);
    return places;
}

}  // namespace rigor::models::mjcf
