/* Contacts as lines along their normals. */
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MeMath.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "me_app_i.h"
#include <string.h>

static void hideFrom(MeAppContactDrawInfo *info, int first) {
    for (int i = first; i < info->count; i++)
        meapp_lineHide(info->lines[i]);
    info->count = first < info->count ? first : info->count;
}

void meapp_contactsFree(MeAppContactDrawInfo *info) {
    for (int i = 0; i < info->max; i++)
        RNLineDestroy(info->lines[i]);
    if (info->lines)
        MeMemoryAPI.destroy(info->lines);
    info->lines = 0;
    info->max = info->count = 0;
}

static MeBool areGood(const float color[4], int max) {
    MeBool isColor = color != 0;
    for (int i = 0; isColor && i < 4; i++)
        isColor = MeRealIsValid((MeReal)color[i]);
    if (!isColor)
        MeWarning(1, "MeAppDrawContactsInit: color is null or not finite");
    if (max < 1)
        MeWarning(1, "MeAppDrawContactsInit: max is %d: it must be positive", max);
    return isColor && max >= 1;
}

void MEAPI MeAppDrawContactsInit(MeApp *const app, float color[4], int max) {
    if (!meapp_check(app, "MeAppDrawContactsInit") || !areGood(color, max))
        return;
    MeAppContactDrawInfo *info = app->contacts;
    meapp_contactsFree(info);
    info->lines = MeMemoryAPI.create((size_t)max * sizeof *info->lines);
    if (!info->lines) {
        MeFatalError(1, "MeAppDrawContactsInit: no memory for %d lines", max);
        return;
    }
    while (info->max < max && (info->lines[info->max] = meapp_lineCreate(app->rc, color)) != 0)
        info->max++;
    app->drawContacts = METRUE;
}

static void drawContact(const MeApp *app, MdtContactID c) {
    MeAppContactDrawInfo *info = app->contacts;
    MeVector3 position, normal, start, end;
    MEASSERT(info->count < info->max);
    MdtContactGetPosition(c, position);
    MdtContactGetNormal(c, normal);
    MeVector3ScaleAndAdd(start, normal, -info->length / 2, position);
    MeVector3ScaleAndAdd(end, normal, info->length / 2, position);
    meapp_lineShow(app->rc, info->lines[info->count], start, end);
    info->count++;
}

/* A group's contacts; or the contact itself, if it is in none. */
static void drawContactsOf(const MeApp *app, MdtConstraintID constraint) {
    const MeAppContactDrawInfo *info = app->contacts;
    const MdtContactGroupID group = MdtConstraintDCastContactGroup(constraint);
    const MdtContactID single = group ? 0 : MdtConstraintDCastContact(constraint);
    if (single && !MdtContactGetContactGroup(single))
        drawContact(app, single);
    if (!group)
        return;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c && info->count < info->max;
         c = MdtContactGroupGetNextContact(group, c))
        drawContact(app, c);
}

void MEAPI MeAppDrawContacts(const MeApp *app) {
    if (!meapp_check(app, "MeAppDrawContacts") || !app->drawContacts || !app->contacts->lines)
        return;
    MeAppContactDrawInfo *info = app->contacts;
    const int before = info->count;
    info->count = 0;
    for (MdtConstraintID c = MdtConstraintGetFirst(app->world); c && info->count < info->max;
         c = MdtConstraintGetNext(c))
        drawContactsOf(app, c);
    MEASSERT(info->count <= info->max);
    for (int i = info->count; i < before; i++)
        meapp_lineHide(info->lines[i]);
}

void MEAPI MeAppToggleDrawContacts(MeApp *app, MeBool d) {
    if (!meapp_check(app, "MeAppToggleDrawContacts"))
        return;
    app->drawContacts = d != 0;
    if (!d)
        hideFrom(app->contacts, 0);
}

void MEAPI MeAppSetContactDrawLength(MeApp *app, MeReal length) {
    if (!meapp_check(app, "MeAppSetContactDrawLength"))
        return;
    if (length > 0 && MeRealIsValid(length))
        app->contacts->length = length;
    else
        MeWarning(1, "MeAppSetContactDrawLength: length is %g: it must be positive", (double)length);
}
