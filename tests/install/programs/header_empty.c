/* Headers that programs name, though nothing or little is in them today. */
#include "McdCompositeModel.h"
#include "McdInteractionTable.h"
#include "McdProfile.h"

int main(void) {
    McdCompositeModelID model = 0;
    return model != 0;
}
