// FCL's answers to the same pairs, as a peer: the only C++ of this program.
#include "nearfield_fcl.h"

#include <fcl/narrowphase/collision.h>

#include <memory>
#include <vector>

namespace {

struct Placed {
    std::shared_ptr<fcl::CollisionGeometryd> geometry;
    fcl::Transform3d place;
};

std::vector<Placed> placed[2];

Placed make(const PeerShape &s) {
    Placed p;
    if (s.isCylinder)
        p.geometry = std::make_shared<fcl::Cylinderd>(s.size[0], s.size[2]);
    else
        p.geometry = std::make_shared<fcl::Boxd>(2 * s.size[0], 2 * s.size[1], 2 * s.size[2]);
    p.place.setIdentity();
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p.place.linear()(k, i) = s.axis[i][k];
    for (int k = 0; k < 3; k++)
        p.place.translation()[k] = s.place[k];
    return p;
}

} // namespace

extern "C" void fcl_clear(void) {
    placed[0].clear();
    placed[1].clear();
}

extern "C" void fcl_add(const PeerShape *a, const PeerShape *b) {
    placed[0].push_back(make(*a));
    placed[1].push_back(make(*b));
}

extern "C" int fcl_collideAll(void) {
    int contacts = 0;
    for (std::size_t i = 0; i < placed[0].size(); i++) {
        const Placed &a = placed[0][i], &b = placed[1][i];
        fcl::CollisionRequestd request(4, true);
        fcl::CollisionResultd result;
        contacts +=
            static_cast<int>(fcl::collide(a.geometry.get(), a.place, b.geometry.get(), b.place, request, result));
    }
    return contacts;
}
