/* Inside MeApp: what its files share. */
#ifndef ME_APP_I_H
#define ME_APP_I_H

#include "MeApp.h"
#include "MeAssert.h"

/* Not null; else a warning. */
MeBool meapp_check(const MeApp *app, const char *function);

/* A context and a finite colour; else a warning (RGeometry.c). */
MeBool meapp_canDraw(const char *function, const RRender *rc, const float color[4]);

/* A line that is in no list yet; null, after a fatal error, without memory. */
RNativeLine *meapp_lineCreate(RRender *rc, const float color[4]);
/* Puts a line's ends somewhere and has it drawn. */
void meapp_lineShow(RRender *rc, RNativeLine *line, const MeVector3 start, const MeVector3 end);
/* Has it no longer drawn. */
void meapp_lineHide(RNativeLine *line);

/* The camera of MeAppFollow, a frame further (MeAppDrive.c). */
void meapp_followStep(MeApp *app);

/* Removes the graphics of models (MeAppUniverse.c). */
void meapp_shownFree(MeApp *app);

/* Frees the lines of the contacts. */
void meapp_contactsFree(MeAppContactDrawInfo *info);

/* What MeAppCreateControls made. */
enum { MEAPP_BALLS = 8, MEAPP_HISTORY = 120, MEAPP_PLOTS = 9, MEAPP_WORKERS = 8 };
enum { MEAPP_SEEN = 2 }; /* Pictures that the selection is outlined in: panels are drawn after layers. */
typedef struct MeAppControls {
    McdModelID balls[MEAPP_BALLS];
    MeU64 ballSerials[MEAPP_BALLS]; /* Another model may come to be in the same place. */
    int thrown;
    MeReal gravity[3]; /* Its direction, while it is 0. */
    int material[2], partition;
    int figuresSeen; /* Frames that the report is still wanted for. */
    MeBool reportIsOurs;
    unsigned int layers; /* MstDebugLayer */
    MeReal forceLength;  /* m for each N of the arrows of contact forces; 0: no force has been seen. */
    MeBool selectedOnly; /* The layers of the selected body alone. */
    int selectionSeen;   /* Pictures that the selection is outlined in. */
    MeU64 inspected;     /* Serial of the model that the inspector showed last, */
    MeReal massBefore;   /* the mass that it had then; */
    int inspectedOther;  /* the material that it has its friction on. */
    MeReal *step;        /* MeAppSetStepPtr's. */
    float history[MEAPP_PLOTS][MEAPP_HISTORY];
    struct {
        double before, mean; /* s: in all as of the last step, 0 if that was not looked at; a step. */
    } worker[MEAPP_WORKERS];
} MeAppControls;

/* The report of the step before, for the plots (MeAppPanels.c). */
void meapp_sampleReport(MeApp *app);
void meapp_createPanels(MeApp *app);
/* The panel "Layers", and what is drawn over the picture (MeAppLayers.c). */
void meapp_createLayers(MeApp *app);
/* Null if nothing is selected. */
MdtBodyID meapp_selectedBody(const MeApp *app);
void MEAPI meapp_showInspector(RRender *rc, void *userdata); /* MeAppInspector.c */
/* A line of a panel, as by printf. */
void meapp_say(const char *format, ...);
int meapp_lastMaterial(McdSpaceID space);
/* Contacts without friction get the friction cone with it, others keep their model. */
void meapp_setFriction(MdtContactParamsID p, MeReal friction);
/* Between steps: another number of threads (MeAppUniverse.c). */
void meapp_setWorkers(MeApp *app, int workers);
/* Takes keys, panels and layers from the context again. */
void meapp_controlsFree(MeApp *app);

#endif
